//! What functions say.

/// What a function says that could not do its work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum EtendueStatus {
    /// The function did its work.
    Ok = 0,
    /// A pointer is NULL that must not be.
    NullPointer = 1,
    /// A count is too large.
    Count = 2,
    /// A value is not one of those allowed.
    Value = 3,
}
