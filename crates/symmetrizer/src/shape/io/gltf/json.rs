//! Looking things up in the JSON of a file, with errors that name the place.

use serde_json::{Map, Value};

use crate::error::{Error, Result};

/// The elements of the array `key`; none where there is no such key.
pub(super) fn list<'a>(object: &'a Value, key: &str) -> &'a [Value] {
    object.get(key).and_then(Value::as_array).map_or(&[], |v| v)
}

/// The members of the object `key`; none where there is no such key.
pub(super) fn members<'a>(
    object: &'a Value,
    key: &str,
) -> impl Iterator<Item = (&'a str, &'a Value)> {
    let map = object.get(key).and_then(Value::as_object);
    map.into_iter().flatten().map(|(k, v)| (k.as_str(), v))
}

/// A name that is not empty.
pub(super) fn name(object: &Value) -> Option<&str> {
    let name = object.get("name").and_then(Value::as_str);
    name.filter(|n| !n.is_empty())
}

/// The whole number `key`, where it is given.
pub(super) fn whole(object: &Value, key: &str, place: &str) -> Result<Option<usize>> {
    match object.get(key) {
        None | Some(Value::Null) => Ok(None),
        Some(value) => match as_whole(value) {
            Some(number) => Ok(Some(number)),
            None => Err(Error::input(
                format!("'{key}' of {place} is {}, not a whole number", brief(value)),
                DAMAGED,
            )),
        },
    }
}

/// The whole number `key`.
pub(super) fn required(object: &Value, key: &str, place: &str) -> Result<usize> {
    whole(object, key, place)?
        .ok_or_else(|| Error::input(format!("{place} has no '{key}'"), DAMAGED))
}

/// Element `index` of the array `of` in the file's root.
pub(super) fn element<'a>(
    root: &'a Value,
    of: &str,
    index: usize,
    place: &str,
) -> Result<&'a Value> {
    let list = list(root, of);
    list.get(index).ok_or_else(|| {
        Error::input(
            format!(
                "{place} names number {index} of '{of}', but there are only {}",
                list.len()
            ),
            DAMAGED,
        )
    })
}

/// A value as an index or count.
pub(super) fn as_whole(value: &Value) -> Option<usize> {
    let whole = value.as_u64().or_else(|| {
        let number = value.as_f64()?;
        let fits = (0.0..9e15).contains(&number) && number.fract() == 0.0;
        fits.then_some(number as u64)
    })?;
    usize::try_from(whole).ok()
}

/// `N` numbers under `key`, where it is given.
pub(super) fn numbers<const N: usize>(
    object: &Value,
    key: &str,
    place: &str,
) -> Result<Option<[f64; N]>> {
    let Some(value) = object.get(key) else {
        return Ok(None);
    };
    let mut numbers = [0.0; N];
    let given = value.as_array().filter(|a| a.len() == N);
    let read = given.and_then(|a| {
        for (number, value) in numbers.iter_mut().zip(a) {
            *number = value.as_f64()?;
        }
        Some(numbers)
    });
    let wrong = || Error::input(format!("'{key}' of {place} is not {N} numbers"), DAMAGED);
    read.map(Some).ok_or_else(wrong)
}

/// The object at `path`, a chain of keys and indices, to be changed; `None` where there is none.
pub(super) fn object_mut<'a>(
    root: &'a mut Value,
    path: &[&dyn ToString],
) -> Option<&'a mut Map<String, Value>> {
    let mut value = root;
    for step in path {
        let step = step.to_string();
        value = match value {
            Value::Object(map) => map.get_mut(&step)?,
            Value::Array(list) => list.get_mut(step.parse::<usize>().ok()?)?,
            _ => return None,
        };
    }
    value.as_object_mut()
}

/// Appends `value` to the array `key` in the root, which is made where there is none, and returns
/// its index.
pub(super) fn append(root: &mut Value, key: &str, value: Value) -> usize {
    if !root.is_object() {
        *root = Value::Object(Map::new());
    }
    let list = root
        .as_object_mut()
        .map(|map| map.entry(key).or_insert_with(|| Value::Array(Vec::new())));
    match list {
        Some(Value::Array(list)) => {
            list.push(value);
            list.len() - 1
        }
        Some(other) => {
            *other = Value::Array(vec![value]);
            0
        }
        None => 0,
    }
}

fn brief(value: &Value) -> String {
    let text = value.to_string();
    match text.char_indices().nth(40) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text,
    }
}

/// The hint for a file whose parts do not fit each other.
pub(super) const DAMAGED: &str = "the file is damaged; export it again";
