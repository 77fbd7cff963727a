//! What to do may stand after options: `-o a.png render scene.toml` is `render -o a.png scene.toml`.
//!
//! The first word that is neither an option nor an option's value is looked at; where it says what to do, it is
//! moved to the front, where the parser expects it.

use clap::{Arg, Command, CommandFactory};
use std::ffi::{OsStr, OsString};

/// The words of a command line, the program's name first, with what to do before all options.
pub(crate) fn verb_first(words: impl IntoIterator<Item = OsString>) -> Vec<OsString> {
    let mut words: Vec<OsString> = words.into_iter().collect();
    let cli = crate::cli::Cli::command();
    if let Some(place) = first_plain_word(&cli, &words)
        && cli.find_subcommand(&words[place]).is_some()
    {
        let verb = words.remove(place);
        words.insert(1, verb);
    }
    words
}

/// Place of the first word after the program's name that is neither an option nor the value of one.
fn first_plain_word(cli: &Command, words: &[OsString]) -> Option<usize> {
    let mut place = 1;
    loop {
        let word = words.get(place)?;
        if word == "--" {
            return None;
        }
        if !is_option(word) {
            return Some(place);
        }
        place += if wants_next(cli, word) { 2 } else { 1 };
    }
}

fn is_option(word: &OsStr) -> bool {
    word.as_encoded_bytes().starts_with(b"-") && word.len() > 1
}

/// Whether the word after this option is its value.
fn wants_next(cli: &Command, option: &OsStr) -> bool {
    let text = option.to_string_lossy();
    match text.strip_prefix("--") {
        Some(name) => !name.contains('=') && takes_value(cli, |arg| arg.get_long() == Some(name)),
        // Of letters in one word the first that takes a value has all that follows it.
        None => {
            let letters: Vec<char> = text.chars().skip(1).collect();
            let valued = letters.iter().position(|&c| takes_value(cli, |arg| arg.get_short() == Some(c)));
            valued.is_some_and(|place| place + 1 == letters.len())
        }
    }
}

/// Whether an option, of rendering or of anything else, takes a value.
fn takes_value(cli: &Command, is_meant: impl Fn(&Arg) -> bool) -> bool {
    let all = std::iter::once(cli).chain(cli.get_subcommands()).flat_map(Command::get_arguments);
    all.into_iter().any(|arg| is_meant(arg) && arg.get_action().takes_values())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ordered(words: &str) -> String {
        let words = verb_first(words.split_whitespace().map(OsString::from));
        words.iter().map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn what_to_do_is_found_behind_options_and_their_values() {
        for (words, expected) in [
            ("hyaline -o x.png render a.toml", "hyaline render -o x.png a.toml"),
            ("hyaline --json -ox.png --spp=4 render a.toml", "hyaline render --json -ox.png --spp=4 a.toml"),
            ("hyaline --diff d.png compare a.exr b.exr", "hyaline compare --diff d.png a.exr b.exr"),
            ("hyaline --strict check a.toml", "hyaline check --strict a.toml"),
        ] {
            assert_eq!(ordered(words), expected);
        }
    }

    #[test]
    fn scenes_and_values_that_look_like_it_stay_where_they_are() {
        for words in [
            "hyaline",
            "hyaline a.toml -o x.png",
            "hyaline --camera render a.toml",
            "hyaline -- render",
            "hyaline render check",
            "hyaline -o",
        ] {
            assert_eq!(ordered(words), words);
        }
    }
}
