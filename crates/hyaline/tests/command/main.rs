//! The command as people meet it: run on small scenes in folders of their own.

mod check;
mod determinism;
mod error_limit;
mod films;
#[cfg(unix)]
mod interruption;
mod memory;
mod support;
mod usage;
