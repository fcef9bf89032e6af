//! What is asked about one part, and what engines share: computed when one first needs it.

use super::analysis::Analysis;
use super::chart::{ChartTest, Kernel};
use super::depth::Depth;
use super::exact::ExactAllowance;
use super::idle_directions::idle_directions;
use super::judge::PartFinding;
use super::lifting::Start;
use super::more_digits::MoreDigits;
use super::options::{AnalysisError, AnalysisOptions};
use super::pose_rank::{PartRank, Pose, TALL, height_at};
use super::tracing::KERNEL_LIMIT;
use super::vocabulary::MobilityClass;
use kutzbach_closure::{Part, Structure};
use kutzbach_math::matrix::MatrixError;
use kutzbach_model::mechanism::Mechanism;
use std::cell::{Cell, OnceCell};

/// A part at a pose.
pub(super) struct Question<'a> {
    pub pose: &'a Pose<'a>,
    pub structure: &'a Structure,
    pub part: &'a Part,
    pub rank: &'a PartRank,
    pub depth: Depth,
    /// The instantaneous freedom, where the rank leaves neither it nor the finite freedom open.
    pub freedom: Cell<Option<usize>>,
    /// The class that subgroups explain.
    pub class: Cell<Option<MobilityClass>>,
    /// Whether subgroups were looked for everywhere.
    pub looked: Cell<bool>,
    /// The chart test, where it was made.
    pub chart: OnceCell<ChartTest>,
    /// The kernel of its equations, where it was computed.
    pub kernel: OnceCell<Option<Kernel>>,
    near: OnceCell<Near>,
}

/// What engines use up, or ask again with.
pub(super) struct Means<'a> {
    pub more: &'a mut MoreDigits,
    /// What is asked of the whole mechanism; `None` where a loop is asked about for the sake of its part.
    pub whole: Option<OfWhole<'a>>,
}

/// What is asked of the whole mechanism, what exact algebra may still do, and how an engine asks all engines again.
pub(super) struct OfWhole<'a> {
    pub options: &'a AnalysisOptions,
    pub allowance: &'a mut ExactAllowance,
    pub again: &'a Again,
}

/// All engines asked again: of a mechanism, and of a part without its budget. Handed to the engines, which need not know who asks
/// them.
pub(super) struct Again {
    pub mechanism: fn(&Mechanism, &AnalysisOptions) -> Result<Analysis, AnalysisError>,
    pub part: fn(&Question<'_>, &mut Means<'_>) -> Result<PartFinding, AnalysisError>,
}

/// What is near a singular pose.
struct Near {
    /// The rank with what the coefficients of power series are in doubt by.
    doubtful: PartRank,
    /// The rank by which loops are closed.
    rank: PartRank,
    /// What is idle at all poses is a factor of the configuration space.
    idle: Vec<Vec<f64>>,
}

impl<'a> Question<'a> {
    pub fn new(
        pose: &'a Pose<'a>,
        structure: &'a Structure,
        (part, rank): (&'a Part, &'a PartRank),
        depth: Depth,
    ) -> Self {
        Self {
            pose,
            structure,
            part,
            rank,
            depth,
            freedom: Cell::new(None),
            class: Cell::new(None),
            looked: Cell::new(false),
            chart: OnceCell::new(),
            kernel: OnceCell::new(),
            near: OnceCell::new(),
        }
    }

    /// Unknowns beyond the number of equations.
    pub fn surplus(&self) -> i64 {
        self.rank.unknowns() as i64 - self.rank.equations() as i64
    }

    /// Whether all equations are independent at the pose.
    pub fn is_independent(&self) -> bool {
        self.freedom
            .get()
            .is_some_and(|freedom| self.surplus() == freedom as i64)
    }

    /// The kernel, or random vectors of one that is too large.
    pub fn of_kernel(&self) -> Result<Option<&Kernel>, MatrixError> {
        if self.kernel.get().is_none() {
            let kernel = Kernel::of(self.pose, self.rank, KERNEL_LIMIT)?;
            let _ = self.kernel.set(kernel);
        }
        Ok(self.kernel.get().and_then(Option::as_ref))
    }

    /// The pose where branches start, once the chart test was made.
    pub fn start(&self) -> Result<Option<Start<'_>>, MatrixError> {
        let (Some(kernel), Some(near)) = (self.of_kernel()?, self.near()?) else {
            return Ok(None);
        };
        Ok(Some(Start {
            pose: self.pose,
            part: self.part,
            rank: &near.rank,
            kernel,
            idle: &near.idle,
        }))
    }

    /// The rank with what the coefficients of power series are in doubt by.
    pub fn doubtful(&self) -> Result<&PartRank, MatrixError> {
        Ok(self.near()?.map_or(self.rank, |near| &near.doubtful))
    }

    /// Whether the coefficients of power series are in doubt by more than rounding.
    pub fn is_rounded(&self) -> Result<bool, MatrixError> {
        Ok(self.doubtful()?.open_by_digits() > self.rank.accuracy)
    }

    /// Whether numbers are written in more digits than doubles hold beside one another.
    pub fn is_tall(&self) -> bool {
        height_at(self.pose, self.part) > TALL
    }

    fn near(&self) -> Result<Option<&Near>, MatrixError> {
        let (Some(kernel), Some(chart)) = (self.of_kernel()?, self.chart.get()) else {
            return Ok(None);
        };
        Ok(Some(self.near.get_or_init(|| {
            // Numbers taken literally close the loops exactly. The coefficients of the series are not for that reason beyond
            // doubt: rounding shifts them by its share of the curvature, of which hardly a tenth remains.
            let [doubt, stated] = match chart.literal {
                true => [0.1, 0.0],
                false => [1.0, 1.0],
            };
            let with = |share: f64| PartRank {
                reading: self.rank.reading.in_share(share),
                ..self.rank.clone()
            };
            let by_kind = self.is_tall();
            Near {
                doubtful: with(doubt),
                rank: with(stated),
                idle: idle_directions(self.pose.mechanism, self.part, kernel, by_kind),
            }
        })))
    }
}
