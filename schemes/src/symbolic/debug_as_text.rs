//! Errors whose `Debug` is their text.

/// Makes the `Debug` of an error its text: that is what `unwrap` and a `main` that returns the error print.
#[doc(hidden)]
#[macro_export]
macro_rules! debug_as_text {
    ($error:ty) => {
        impl std::fmt::Debug for $error {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                std::fmt::Display::fmt(self, f)
            }
        }
    };
}
