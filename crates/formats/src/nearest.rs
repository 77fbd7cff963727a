//! What somebody may have meant.

/// The candidate most like `word`, the first of equals; case does not count.
pub(crate) fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = shortened(word);
    let distance = |candidate: &str| strsim::damerau_levenshtein(&word, &shortened(candidate));
    candidates.into_iter().min_by_key(|candidate| distance(candidate))
}

/// Whether `word` could be a slip of the pen for `candidate`.
pub(crate) fn is_similar(word: &str, candidate: &str) -> bool {
    let distance = strsim::damerau_levenshtein(&shortened(word), &shortened(candidate));
    distance <= 1 + candidate.chars().count() / 4
}

/// The advice `did you mean 'x'?`, or the list of what there is.
pub(crate) fn advice(word: &str, candidates: &[&str]) -> String {
    let list = || candidates.iter().map(|c| format!("'{c}'")).collect::<Vec<_>>().join(", ");
    match nearest(word, candidates.iter().copied()) {
        None => "remove it".to_owned(),
        Some(candidate) if candidates.len() == 1 => format!("did you mean '{candidate}'?"),
        Some(candidate) => format!("did you mean '{candidate}'? Known here: {}", list()),
    }
}

/// Lower case and no longer than any name of ours could be: the comparison takes quadratic time.
fn shortened(word: &str) -> String {
    word.chars().take(64).flat_map(char::to_lowercase).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_pen_are_recognized() {
        assert_eq!(nearest("raduis", ["height", "radius", "center"]), Some("radius"));
        assert_eq!(nearest("Center", ["height", "center"]), Some("center"));
        assert_eq!(nearest("x", []), None);
        assert!(is_similar("raduis", "radius"));
        assert!(!is_similar("height", "radius"));
    }
}
