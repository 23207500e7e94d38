//! Objects of JSON whose keys keep their order, unlike those of `serde_json`.

use serde::{Serialize, Serializer};
use serde_json::Value;

/// An object: its keys with their values.
#[derive(Debug)]
pub struct Object(pub Vec<(&'static str, Json)>);

/// A value whose objects keep the order of their keys.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Json {
    /// Nothing, a number, a text, ….
    Value(Value),
    /// A list.
    List(Vec<Json>),
    /// An object.
    Object(Object),
}

impl Serialize for Object {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(key, value)| (key, value)))
    }
}

/// What `serde_json` has a value of.
macro_rules! plain {
    ($($Type:ty),+) => {
        $(impl From<$Type> for Json {
            fn from(value: $Type) -> Self {
                Json::Value(value.into())
            }
        })+
    };
}

plain!(bool, u32, usize, f64, &str, String);

impl From<Object> for Json {
    fn from(object: Object) -> Self {
        Json::Object(object)
    }
}

impl<T: Into<Json>> From<Vec<T>> for Json {
    fn from(list: Vec<T>) -> Self {
        Json::List(list.into_iter().map(Into::into).collect())
    }
}

impl<T: Into<Json>> From<Option<T>> for Json {
    fn from(value: Option<T>) -> Self {
        value.map_or(Json::Value(Value::Null), Into::into)
    }
}
