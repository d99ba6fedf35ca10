//! Comments without characters beyond ASCII: some compilers read nothing else without being told.

const NAMES: &[(&str, &str)] = &[
    ("cosθ'", "cos(theta')"),
    ("cosθ", "cos(theta)"),
    ("cosσ", "cos(sigma)"),
    ("sinγ", "sin(gamma)"),
    ("Ω⊥", "Omega'"),
    ("Ω", "Omega"),
    ("θ", "theta"),
    ("σ", "sigma"),
    ("γ", "gamma"),
    ("α", "alpha"),
    ("4πR", "4 pi R"),
    ("2π(", "2 pi ("),
    ("4π", "4 pi"),
    ("2π", "2 pi"),
    ("π", "pi"),
    ("·", "*"),
    ("×", "x"),
    ("∂", "d"),
    ("−", "-"),
    ("≤", "<="),
    ("≥", ">="),
    ("∞", "infinity"),
    ("√", "sqrt "),
    ("∛", "cbrt "),
    ("…", "..."),
    ("→", "->"),
    ("–", "-"),
    ("½", "1/2"),
    ("₀", "0"),
    ("₁", "1"),
    ("∫", "integral of "),
];

/// Exponents as `^` and digits.
fn with_plain_exponents(text: &str) -> String {
    const RAISED: &str = "⁻⁰¹²³⁴⁵⁶⁷⁸⁹";
    let (mut all, mut inside) = (String::new(), false);
    for c in text.chars() {
        let place = RAISED.chars().position(|raised| raised == c);
        if place.is_some() && !inside {
            all.push('^');
        }
        inside = place.is_some();
        all.push(place.and_then(|place| "-0123456789".chars().nth(place)).unwrap_or(c));
    }
    all
}

/// Lines of a comment of at most 120 characters.
pub(crate) fn comment(text: &str, margin: &str) -> String {
    let text =
        NAMES.iter().fold(with_plain_exponents(&text.replace('`', "")), |text, (from, to)| text.replace(from, to));
    assert!(text.is_ascii(), "a comment has characters beyond ASCII; add them to the list: {text}");
    let (mut all, mut line) = (String::new(), String::new());
    for word in text.split_whitespace() {
        if margin.len() + 3 + line.len() + 1 + word.len() > 120 {
            all += &format!("{margin}//{line}\n");
            line.clear();
        }
        line += " ";
        line += word;
    }
    if !line.is_empty() {
        all += &format!("{margin}//{line}\n");
    }
    all
}
