//! Names in words.

/// `SomeName` as `some_name`.
#[must_use]
pub fn snake(name: &str) -> String {
    let mut all = String::new();
    for c in name.chars() {
        if c.is_uppercase() && !all.is_empty() {
            all.push('_');
        }
        all.extend(c.to_lowercase());
    }
    all
}
/// `some_name` as `SomeName`.
#[must_use]
pub fn pascal(name: &str) -> String {
    let word = |word: &str| {
        let mut letters = word.chars();
        letters.next().map(|first| first.to_uppercase().chain(letters).collect::<String>()).unwrap_or_default()
    };
    name.split('_').map(word).collect()
}
