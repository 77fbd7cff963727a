//! The command `hyaline`: render, merge, develop, compare, check.

mod argument;
mod check_command;
mod cli;
mod compare_command;
mod digest;
mod excerpt;
mod failure;
mod film_command;
mod film_file;
mod inventory;
mod limit;
mod memory;
mod message;
mod output;
mod picture;
mod plan;
mod progress_bar;
mod render_command;
mod report;
mod scene_source;
mod signal;
mod used_settings;
mod word_order;

use clap::Parser;
use cli::{Cli, Command};
use failure::Failure;
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = Cli::parse_from(word_order::verb_first(std::env::args_os()));
    let result = match cli.command {
        None => render_command::run(&cli.render),
        Some(Command::Render(arguments)) => render_command::run(&arguments),
        Some(Command::Merge(arguments)) => film_command::merge(&arguments),
        Some(Command::Develop(arguments)) => film_command::develop(&arguments),
        Some(Command::Compare(arguments)) => compare_command::run(&arguments),
        Some(Command::Check(arguments)) => check_command::run(&arguments),
        Some(Command::View(_)) => Err(Failure::not_yet("view")),
    };
    match result {
        Ok(code) => ExitCode::from(code),
        Err(failure) => {
            failure.print();
            ExitCode::from(failure.code)
        }
    }
}
