//! What messages about estimators have in common: the options are flags for one caller and keys for another.

use shadowstep::shadow::{EstimatorSettings, OptionConflict};

/// How to mend a target error that is not valid.
pub const ACCURACY_HINT: &str =
    "write the target error, such as 1e-20, or leave it out for the smallest error possible";

/// What is wrong with conflicting options, and what would be right. `option` is the name of the one that cannot be used, and
/// `assigned` writes a name with its value, both as they are spelt where they are set.
pub fn conflict(conflict: &OptionConflict, option: &str, assigned: impl Fn(&str, &str) -> String) -> (String, String) {
    let required = assigned(conflict.setting, conflict.required);
    let found = assigned(conflict.setting, &conflict.found);
    (format!("{option} is for {required}, not for {found}"), format!("leave it out, or write {required}"))
}

/// The option that sets the order, or the largest one that is tried: `order` or `max_order`, with its value.
pub fn order_setting(settings: &EstimatorSettings) -> Option<(&'static str, u32)> {
    let options = settings.options();
    options.order.map(|order| ("order", order)).or_else(|| options.max_order.map(|order| ("max_order", order)))
}
