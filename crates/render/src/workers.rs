//! The threads that render.

use std::io;
use std::num::NonZeroUsize;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::Duration;

/// How often the watching thread looks at what the workers do.
const WATCH_INTERVAL: Duration = Duration::from_millis(100);

/// Stack of a thread, bytes: room for the deepest recursion of `whitted`; untouched pages cost nothing.
const STACK_SIZE: usize = 32 << 20;

/// A set of threads. What they compute does not depend on how many they are.
#[derive(Debug)]
pub struct Workers {
    pool: rayon::ThreadPool,
}

impl Workers {
    /// Starts `threads` threads; `None`: one for every processor.
    ///
    /// # Errors
    /// The system refuses to start that many.
    pub fn new(threads: Option<NonZeroUsize>) -> io::Result<Self> {
        let builder = rayon::ThreadPoolBuilder::new()
            .num_threads(threads.map_or(0, NonZeroUsize::get))
            .stack_size(STACK_SIZE);
        Ok(Self { pool: builder.build().map_err(io::Error::other)? })
    }

    /// Number of threads.
    pub fn count(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// Runs `work` on the threads: what it does in parallel, they share.
    pub fn run<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.pool.install(work)
    }

    /// Runs `work` on the threads, and calls `watch` on this one now and then meanwhile.
    pub(crate) fn run_watched<R: Send>(&self, work: impl FnOnce() -> R + Send, mut watch: impl FnMut()) -> R {
        let mut result = None;
        let slot = &mut result;
        let (done, is_done) = mpsc::channel::<()>();
        self.pool.in_place_scope(|scope| {
            scope.spawn(move |_| {
                *slot = Some(work());
                drop(done);
            });
            while let Err(RecvTimeoutError::Timeout) = is_done.recv_timeout(WATCH_INTERVAL) {
                watch();
            }
        });
        // The scope passes a panic of `work` on, so that past it there is a result.
        result.expect("work has run")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_watched_until_it_is_done() {
        let workers = Workers::new(NonZeroUsize::new(2)).unwrap();
        let mut looks = 0;
        let answer = workers.run_watched(
            || {
                std::thread::sleep(3 * WATCH_INTERVAL);
                42
            },
            || looks += 1,
        );
        assert_eq!(answer, 42);
        assert!(looks >= 1);
        assert_eq!(workers.count(), 2);
    }
}
