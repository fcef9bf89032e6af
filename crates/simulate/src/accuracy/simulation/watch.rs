//! How far everything has come, for whoever waits and may break it off.

use crate::verification::{Moment, Observer, Passage};
use std::ops::ControlFlow;

/// Asked between moments how far everything has come, from 0 to 1; a break ends it.
pub(in crate::accuracy) type Watch<'w> = dyn FnMut(f64, &str) -> ControlFlow<()> + 'w;

/// Hands the progress of one run on as that of all.
pub(super) struct Watched<'v, 'w> {
    pub watch: &'v mut Watch<'w>,
    pub from: f64,
    pub share: f64,
}

impl Observer for Watched<'_, '_> {
    fn begin(&mut self, passage: &Passage) -> ControlFlow<()> {
        (self.watch)(self.from, &passage.title)
    }

    fn moment(&mut self, moment: &Moment<'_>) -> ControlFlow<()> {
        let done = self.from + self.share * moment.done.clamp(0.0, 1.0);
        (self.watch)(done, "")
    }
}

/// Remembers that a run was broken off.
pub(super) struct Stopped<'s, 'v, 'w> {
    pub inner: &'s mut Watched<'v, 'w>,
    pub stopped: bool,
}

impl Observer for Stopped<'_, '_, '_> {
    fn begin(&mut self, passage: &Passage) -> ControlFlow<()> {
        let flow = self.inner.begin(passage);
        self.stopped |= flow.is_break();
        flow
    }

    fn moment(&mut self, moment: &Moment<'_>) -> ControlFlow<()> {
        let flow = self.inner.moment(moment);
        self.stopped |= flow.is_break();
        flow
    }
}
