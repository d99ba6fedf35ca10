//! Enumerations whose values have names on command lines and in files.

/// Declares an enumeration whose values each have one line of documentation, and a name.
macro_rules! named {
    (
        $(#[$meta:meta])*
        pub enum $Type:ident { $(#[doc = $about:literal] $(#[$more:meta])* $Value:ident = $name:literal,)+ }
    ) => {
        $(#[$meta])*
        #[cfg_attr(feature = "exr", derive(serde::Serialize, serde::Deserialize))]
        pub enum $Type {
            $(#[doc = $about] $(#[$more])* #[cfg_attr(feature = "exr", serde(rename = $name))] $Value,)+
        }

        impl $Type {
            /// All values.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$Value),+];
            /// The name of each value, and what it means.
            pub const NAMES: [[&'static str; 2]; Self::ALL.len()] = [$([$name, $about.trim_ascii()]),+];
            /// Its name on command lines and in files.
            #[must_use]
            pub const fn name(self) -> &'static str {
                Self::NAMES[self as usize][0]
            }
        }

        impl std::str::FromStr for $Type {
            type Err = String;
            /// The value of a name.
            fn from_str(text: &str) -> Result<Self, String> {
                let found = Self::ALL.into_iter().find(|value| value.name() == text);
                found.ok_or_else(|| format!("{text:?} is none of {}", Self::NAMES.map(|[name, _]| name).join(", ")))
            }
        }
    };
}

pub(crate) use named;
