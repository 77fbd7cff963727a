//! Tests of the conversions.

use super::super::document;
use super::*;

/// Reads `text` as the value of a key `x`.
fn with<T>(text: &str, check: impl FnOnce(Field<'_>) -> T) -> T {
    let root = document::parse(&format!("x = {text}"), &"a.toml".into()).unwrap();
    check(Table::root(&root).unwrap().take("x").unwrap())
}

#[test]
fn lengths_are_numbers_or_strings_with_a_unit() {
    assert_eq!(with("2", |x| x.length(1.0, Limits::ANY)).unwrap(), 2.0);
    assert_eq!(with("\"2 mm\"", |x| x.length(1.0, Limits::ANY)).unwrap(), 0.002);
    assert_eq!(with("\"2 mm\"", |x| x.length(0.001, Limits::ANY)).unwrap(), 2.0);
    assert_eq!(with("2", |x| x.length(0.001, Limits::ANY)).unwrap(), 2.0, "plain numbers are scene units");
    assert!(with("1e300", |x| x.length(1.0, Limits::ANY)).is_err());
    assert!(with("1e-300", |x| x.length(1.0, Limits::POSITIVE)).is_err());
    assert!(with("true", |x| x.length(1.0, Limits::ANY)).is_err());
}

#[test]
fn colors_are_triples_hexadecimal_or_grey() {
    assert_eq!(with("[0.5, 1, 0]", |x| x.color(Limits::FRACTION)).unwrap(), [0.5, 1.0, 0.0]);
    assert_eq!(with("0.25", |x| x.color(Limits::FRACTION)).unwrap(), [0.25; 3]);
    assert_eq!(with("\"#ff0000\"", |x| x.color(Limits::FRACTION)).unwrap(), [1.0, 0.0, 0.0]);
    assert!(
        with("\"#ff0000\"", |x| x.color(Limits::TRANSMITTANCE)).is_err(),
        "limits hold for all spellings"
    );
    assert!(with("[0.5, 1.5, 0]", |x| x.color(Limits::FRACTION)).is_err());
    assert!(with("[0.5, 1]", |x| x.color(Limits::FRACTION)).is_err());
    assert!(with("1e39", |x| x.color(Limits::NOT_NEGATIVE)).is_err(), "f32 can't hold it");
}

#[test]
fn numbers_that_are_none_are_refused_where_they_stand() {
    for text in ["nan", "inf", "-inf", "\"1\"", "true", "[1]"] {
        let error = with(text, |x| x.number(Limits::ANY).unwrap_err());
        let source = error.source.unwrap();
        assert_eq!((source.line, source.column), (1, 5), "{text}");
        assert!(error.message.starts_with("`x` must be "), "{}", error.message);
    }
}

#[test]
fn choices_name_the_nearest() {
    let error = with("\"spehre\"", |x| x.choice(&[("sphere", 1), ("disc", 2)]).unwrap_err());
    assert!(error.to_string().contains("did you mean 'sphere'?"), "{error}");
}

#[test]
fn directions_have_a_length() {
    assert!(with("[0, 0, 0]", |x| x.direction()).is_err());
    assert_eq!(with("[0, 2, 0]", |x| x.direction()).unwrap(), DVec3::new(0.0, 2.0, 0.0));
}

#[test]
fn whole_numbers_keep_their_range() {
    assert_eq!(with("7", |x| x.count(1)).unwrap(), 7);
    assert!(with("0", |x| x.count(1)).is_err());
    assert_eq!(with("7e2", |x| x.count(1)).unwrap(), 700);
    assert!(with("7.5", |x| x.count(1)).is_err());
    assert!(with("1e40", |x| x.count(1)).is_err());
    assert!(with("4294967296", |x| x.count(1)).is_err());
}
