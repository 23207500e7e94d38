//! Messages about the options of estimators, which are flags for one caller and keys for another.

use shadowstep::shadow::{EstimatorSettings, OptionConflict};

/// The hint for a target error that is not valid.
pub const ACCURACY_HINT: &str = "write a target error such as 1e-20, or remove it for the best order of each state";

/// What is wrong with conflicting options, and what would be right. `option` is the name of the one that cannot be
/// used, and `assigned` writes a name with its value, both as they are spelt where they are set.
pub fn conflict(conflict: &OptionConflict, option: &str, assigned: impl Fn(&str, &str) -> String) -> (String, String) {
    let required = assigned(conflict.setting, conflict.required);
    let found = assigned(conflict.setting, &conflict.found);
    (format!("{option} requires {required}, not {found}"), format!("remove it, or write {required}"))
}

/// The option that sets the order, or the largest one that is tried: `order` or `max_order`, with its value.
pub fn order_setting(settings: &EstimatorSettings) -> Option<(&'static str, u32)> {
    let options = settings.options();
    options.order.map(|order| ("order", order)).or_else(|| options.max_order.map(|order| ("max_order", order)))
}
