//! The measure of a greatest error.

/// The greatest of the values taken so far, and where it occurred. A NaN counts as infinite, so that it cannot hide.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Greatest<A = ()> {
    found: Option<(f64, A)>,
}

impl<A: Copy> Greatest<A> {
    /// Nothing taken yet.
    pub const NONE: Self = Self { found: None };
    /// Takes one more value into account.
    pub fn take(&mut self, value: f64, at: A) {
        let value = if value.is_nan() { f64::INFINITY } else { value };
        if self.found.is_none_or(|(most, _)| value > most) {
            self.found = Some((value, at));
        }
    }
    /// The greatest value, but at least 0.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.found.map_or(0.0, |(value, _)| value.max(0.0))
    }
    /// The greatest value, or NaN if none was taken.
    #[must_use]
    pub fn measured(&self) -> f64 {
        self.found.map_or(f64::NAN, |(value, _)| value)
    }
    /// Where the greatest value occurred.
    #[must_use]
    pub fn at(&self) -> Option<A> {
        self.found.map(|(_, at)| at)
    }
}

impl<A: Copy> FromIterator<(f64, A)> for Greatest<A> {
    fn from_iter<I: IntoIterator<Item = (f64, A)>>(values: I) -> Self {
        let mut greatest = Self::NONE;
        values.into_iter().for_each(|(value, at)| greatest.take(value, at));
        greatest
    }
}

impl FromIterator<f64> for Greatest {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        values.into_iter().map(|value| (value, ())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nan_is_the_greatest() {
        let mut greatest = Greatest::NONE;
        assert!(greatest.measured().is_nan() && greatest.error() == 0.0 && greatest.at().is_none());
        greatest.take(-1.0, "a");
        assert_eq!((greatest.measured(), greatest.error(), greatest.at()), (-1.0, 0.0, Some("a")));
        for (value, at) in [(2.0, "b"), (1.0, "c"), (2.0, "d")] {
            greatest.take(value, at);
        }
        assert_eq!((greatest.error(), greatest.at()), (2.0, Some("b")));
        greatest.take(f64::NAN, "e");
        greatest.take(3.0, "f");
        assert_eq!((greatest.error(), greatest.at()), (f64::INFINITY, Some("e")));
        assert_eq!([1.0, f64::NAN, 2.0].into_iter().collect::<Greatest>().error(), f64::INFINITY);
    }
}
