//! Wall and processor time.

use std::time::Instant;

use rustix::time::{ClockId, clock_gettime};

/// A running clock.
pub struct Clock {
    wall: Instant,
    cpu: f64,
}

impl Clock {
    /// Starts it.
    pub fn start() -> Self {
        Self {
            wall: Instant::now(),
            cpu: processor(),
        }
    }

    /// Seconds since the start.
    pub fn wall(&self) -> f64 {
        self.wall.elapsed().as_secs_f64()
    }

    /// Seconds of processor time since the start, of all threads together.
    pub fn cpu(&self) -> f64 {
        processor() - self.cpu
    }
}

fn processor() -> f64 {
    let t = clock_gettime(ClockId::ProcessCPUTime);
    t.tv_sec as f64 + 1e-9 * t.tv_nsec as f64
}
