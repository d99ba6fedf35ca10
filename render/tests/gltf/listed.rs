//! The list of what glTF files can say, against the reader: of a file that says all of it, one thing at a time is changed or left out.

use crate::kit::Folder;
use etendue_render::scene::Scene;
use etendue_scene::list::{Entry, GLTF, Parameter, State};
use etendue_scene::{Asked, contents, load_as};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// A file in which each property of the list is given, and none has its default.
const EVERYTHING: &str = include_str!("everything.gltf");

/// A property of an object of the file: where the object is, and what the list says of it.
struct Place {
    object: String,
    entry: &'static Entry,
    parameter: &'static Parameter,
}

/// Where the file has which properties.
fn places(object: &Value, at: &str, entry: &'static Entry, found: &mut Vec<Place>) {
    let extensions = object["extensions"].as_object().into_iter().flatten();
    for (name, value) in extensions {
        let of = GLTF.entry(name, "").unwrap_or_else(|| panic!("{at}: {name} is not listed"));
        places(value, &format!("{at}/extensions/{name}"), of, found);
    }
    for parameter in entry.parameters.iter().filter(|parameter| parameter.name != "*") {
        let Some(value) = object.get(parameter.name) else { continue };
        found.push(Place { object: at.to_owned(), entry, parameter });
        let Some(of) = GLTF.entry(parameter.kind.trim_end_matches("[]"), "") else { continue };
        let at = format!("{at}/{}", parameter.name);
        match value {
            Value::Array(list) => {
                list.iter().enumerate().for_each(|(k, value)| places(value, &format!("{at}/{k}"), of, found));
            }
            value => places(value, &at, of, found),
        }
    }
}

/// All that a file becomes, and its warnings: by default, by its other camera, and in its other scene.
fn read(json: &Value, folder: &Folder) -> Result<(String, String), String> {
    let path = folder.write("a.gltf", serde_json::to_vec(json).unwrap());
    let asked = [(None, None), (Some("other eye"), None), (Some("near"), Some("some")), (Some("far"), None)];
    let (mut all, mut warnings) = (String::new(), String::new());
    for (camera, scene) in asked {
        let asked = Asked { camera: camera.map(str::to_owned), scene: scene.map(str::to_owned), sky: None };
        all += &format!("{:?}", contents(&path, &asked).map_err(|error| error.to_string())?);
        let read = load_as(&path, &asked).map_err(|error| error.to_string())?;
        warnings += &format!("{:?}", read.warnings);
        all += &format!("{:?}", Scene { inputs: Vec::new(), warnings: Vec::new(), stand_ins: Vec::new(), ..read });
    }
    Ok((all, warnings))
}

/// Other values of the same type.
fn others(value: &Value) -> Vec<Value> {
    let other = |x: &Value| x.as_f64().map_or_else(|| x.clone(), |x| json!(x * 0.5 + 0.125));
    match value {
        Value::Bool(of) => vec![json!(!of)],
        Value::Number(_) if value.is_f64() => vec![other(value)],
        Value::Number(_) => [0, 1, 2, 3, 8, 33071, 9729, 5121].map(Value::from).into(),
        Value::String(_) => vec![json!("BLEND"), json!("directional"), json!("orthographic"), json!("data:,")],
        Value::Array(list) if list.iter().all(Value::is_number) => {
            let integers = list.iter().rev().cloned().collect();
            vec![Value::Array(list.iter().map(other).collect()), integers]
        }
        Value::Array(list) if list.iter().all(Value::is_string) => vec![json!(["EXT_of_nobody"])],
        _ => Vec::new(),
    }
}

/// The file with another value of a property, or without it.
fn with(json: &Value, place: &Place, value: Option<Value>) -> Value {
    let mut json = json.clone();
    let object = json.pointer_mut(&place.object).unwrap().as_object_mut().unwrap();
    match value {
        Some(value) => drop(object.insert(place.parameter.name.to_owned(), value)),
        None => drop(object.remove(place.parameter.name)),
    }
    json
}

fn all_places(json: &Value) -> Vec<Place> {
    let mut found = Vec::new();
    places(json, "", GLTF.entry("glTF", "").unwrap(), &mut found);
    found
}

/// What is exact or approximated changes what is read, or fails; what is ignored is a warning and, as what is inert, changes nothing. All that is
/// listed is tried.
#[test]
fn the_reader_asks_for_what_is_listed() {
    let (json, folder) = (serde_json::from_str::<Value>(EVERYTHING).unwrap(), Folder::new());
    let (whole, warnings) = read(&json, &folder).unwrap();
    let mut tried: BTreeMap<(&str, &str), (State, bool)> = BTreeMap::new();
    let mut faults = Vec::new();
    for place in all_places(&json) {
        let Parameter { name, state, .. } = place.parameter;
        let own = json.pointer(&format!("{}/{name}", place.object)).unwrap();
        let asks = matches!(state, State::Exact | State::Approximated);
        let row = tried.entry((place.entry.name, name)).or_insert((*state, false));
        for value in others(own).into_iter().map(Some).chain([None]) {
            if asks && row.1 {
                break;
            }
            let changed = with(&json, &place, value.clone());
            row.1 |= match read(&changed, &folder) {
                Ok((read, said)) => read != whole || asks && said != warnings,
                Err(_) => asks,
            };
        }
    }
    for entry in &GLTF.entries {
        for parameter in entry.parameters.iter().filter(|parameter| parameter.name != "*") {
            let what = format!("{}, {}, listed as {}", entry.name, parameter.name, parameter.state.name());
            match tried.get(&(entry.name, parameter.name)) {
                None => faults.push(format!("{what}: is not in the file")),
                Some((State::Exact | State::Approximated, false)) => faults.push(format!("{what}: changes nothing")),
                Some((State::Ignored | State::Inert, true)) => faults.push(format!("{what}: changes what is read")),
                Some((State::Ignored, _)) if !warnings.contains(parameter.name) => {
                    faults.push(format!("{what}: has no warning"));
                }
                _ => {}
            }
        }
    }
    assert!(tried.len() > 140, "{}", tried.len());
    assert!(faults.is_empty(), "{} of {}:\n{}", faults.len(), tried.len(), faults.join("\n"));
}

/// A property of its default is the same as none.
#[test]
fn defaults_of_gltf_are_those_of_the_list() {
    let (json, folder) = (serde_json::from_str::<Value>(EVERYTHING).unwrap(), Folder::new());
    let (mut faults, mut count) = (Vec::new(), 0);
    for place in all_places(&json) {
        let Parameter { name, kind, default, state, .. } = place.parameter;
        if default.is_empty() || matches!(state, State::Ignored | State::Inert) {
            continue;
        }
        let own = json.pointer(&format!("{}/{name}", place.object)).unwrap();
        let numbers: Vec<Value> = default.split(' ').filter_map(|word| serde_json::from_str(word).ok()).collect();
        let value = match (*kind, &numbers[..]) {
            ("number[16]", _) => (0..16).map(|k| u8::from(k % 5 == 0)).collect(),
            ("number[]", [one]) => vec![one.clone(); own.as_array().unwrap().len()].into(),
            (_, []) => json!(default),
            (_, [one]) => one.clone(),
            (_, list) => json!(list),
        };
        let [given, none] = [Some(value), None].map(|value| read(&with(&json, &place, value), &folder));
        count += 1;
        if given != none {
            faults.push(format!("{}/{name} {default}:\n  {given:.300?}\n  {none:.300?}", place.object));
        }
    }
    assert!(count > 40, "{count}");
    assert!(faults.is_empty(), "{} of {count}:\n{}", faults.len(), faults.join("\n"));
}
