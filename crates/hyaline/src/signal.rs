//! Interruption: the first signal asks the render to stop and write what there is, the second ends at once.

use signal_hook::consts::{SIGINT, SIGTERM};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Which signals have come.
#[derive(Debug)]
pub(crate) struct Signals {
    /// Set by the first signal.
    pub(crate) cancel: Arc<AtomicBool>,
    received: Arc<AtomicUsize>,
}

impl Signals {
    /// Starts to listen to SIGINT and SIGTERM.
    ///
    /// # Errors
    /// The system refuses.
    pub(crate) fn listen() -> std::io::Result<Self> {
        let signals = Self { cancel: Arc::default(), received: Arc::default() };
        for signal in [SIGINT, SIGTERM] {
            let cancel = || Arc::clone(&signals.cancel);
            // Actions run in the order they are registered, so this one sees only what an earlier signal has set.
            signal_hook::flag::register_conditional_shutdown(signal, 128 + signal, cancel())?;
            signal_hook::flag::register_usize(signal, Arc::clone(&signals.received), signal as usize)?;
            signal_hook::flag::register(signal, cancel())?;
        }
        Ok(signals)
    }

    /// Exit code of an interrupted run: 130 or 143; `None` while no signal has come.
    pub(crate) fn exit_code(&self) -> Option<u8> {
        match self.received.load(Ordering::SeqCst) {
            0 => None,
            signal => Some(128 + signal as u8),
        }
    }
}
