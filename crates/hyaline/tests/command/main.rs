//! The command as people meet it: run on small scenes in folders of their own.

mod check;
mod determinism;
mod films;
#[cfg(unix)]
mod interruption;
mod support;
mod usage;
