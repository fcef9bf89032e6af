//! What a verification may cost, counted in work.
//!
//! A clock would make the answer depend on the machine and on what else runs there. So the work of a simulation is estimated
//! before it is begun, from its steps and sizes, in seconds that it takes on a usual machine; one that does not fit into
//! what is left of the budget is not begun, and the answer says what was not tested.

use super::driven_motion::DrivenMotion;
use super::excitation::SUBSTEPS;
use kutzbach_mobility::Structure;
use kutzbach_model::mechanism::Mechanism;

/// Seconds for a substep: of every world, for each body, and for each body and pair of coordinates, since the engine sums
/// up a dense mass matrix body by body. Within a factor of two of what trees, chains and coupled humanoids of 20 to 60
/// coordinates took (2.3 ms for a tree of 60); trees that branch at the ground take half of it.
const SUBSTEP: [f64; 3] = [2e-6, 6e-7, 1.1e-8];

/// Seconds for a look at a moment: for each joint, and for each variable of the loops to the third power, as the predicted
/// pose next to a simulated one takes a few ranks.
const LOOK: [f64; 2] = [2e-6, 5e-8];

/// Seconds for one of the poses that a way is traced through: for each joint, and for each variable of the loops to the
/// third power, as its equations are sparse and solved without a rank.
const TRACED: [f64; 2] = [2e-6, 5e-10];

/// Poses that tracing a way takes: those of its schedule and about half as many steps of the curve.
const POSES: f64 = 600.0;

/// The share of a budget that is meant for the coarse rungs of all ways; the rest is left for finer ones.
const COARSE_SHARE: f64 = 0.6;

/// So many rungs are counted as the coarse ones: most ways are decided by them.
const COARSE_RUNGS: usize = 3;

/// No way is made shorter than this for the sake of a budget (s): a radian or so of the fastest joint.
const SHORTEST_TIME: f64 = 1.0;

/// How large a mechanism is, for the cost of its simulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Size {
    /// Links, and wheels that couplings are made of.
    pub bodies: f64,
    /// Variables of joints and wheels.
    pub variables: f64,
    /// Those of joints in loops and couplings.
    pub looped: f64,
}

impl Size {
    pub fn of(mechanism: &Mechanism, looped: usize) -> Self {
        let wheels = wheels(mechanism);
        Self {
            bodies: (mechanism.links().len() + wheels) as f64,
            variables: (mechanism.freedom() + wheels) as f64,
            looped: looped as f64,
        }
    }

    /// Seconds for steps of so many substeps each.
    pub fn steps(&self, steps: f64, substeps: usize) -> f64 {
        let [any, body, matrix] = SUBSTEP;
        let each = any + body * self.bodies + matrix * self.bodies * self.variables.powi(2);
        steps * substeps as f64 * each
    }

    /// Seconds for looking at so many moments.
    pub fn looks(&self, moments: f64) -> f64 {
        let [joint, cubed] = LOOK;
        moments * (joint * self.bodies + cubed * self.looped.powi(3))
    }

    /// Seconds for tracing the branch along one way.
    pub fn trace(&self) -> f64 {
        let [joint, cubed] = TRACED;
        POSES * (joint * self.bodies + cubed * self.looped.powi(3))
    }

    /// So many moments of a passage are worth looking at: looking may cost a second.
    pub fn moments(&self, most: usize) -> usize {
        let affordable = 1.0 / self.looks(1.0).max(1e-9);
        (affordable as usize).clamp(FEWEST.min(most), most)
    }
}

/// At least so many moments of a passage are looked at.
const FEWEST: usize = 24;

/// What is left to spend.
#[derive(Clone, Debug)]
pub(super) struct Budget {
    all: Option<f64>,
    spent: f64,
}

impl Budget {
    /// Of so many seconds of work; without limit if `None`.
    pub fn new(seconds: Option<f64>) -> Self {
        Self {
            all: seconds,
            spent: 0.0,
        }
    }

    /// Spends on a piece of work, unless it costs more than is left.
    pub fn affords(&mut self, cost: f64) -> bool {
        let fits = self.all.is_none_or(|all| self.spent + cost <= all);
        if fits {
            self.spent += cost;
        }
        fits
    }

    /// Spends on work that is already done.
    pub fn charge(&mut self, cost: f64) {
        self.spent += cost;
    }

    /// So much of all there was; `None` without limit.
    pub fn share(&self, share: f64) -> Option<f64> {
        self.all.map(|all| share * all)
    }

    /// How long so many ways may last each (s), no longer than wanted, for the coarse rungs of all of them to fit into the
    /// budget: a short way along every part says more than a long one along a few.
    pub fn longest(
        &self,
        size: &Size,
        ways: usize,
        (time_step, ladder): (f64, &[usize]),
        wanted: f64,
    ) -> f64 {
        let Some(all) = self.all else {
            return wanted;
        };
        let coarse: usize = ladder.iter().take(COARSE_RUNGS).sum();
        let second = ways as f64 * size.steps(1.0 / time_step, coarse);
        (COARSE_SHARE * all / second).clamp(SHORTEST_TIME.min(wanted), wanted)
    }

    /// `the budget of 60 s`.
    pub fn words(&self) -> String {
        match self.all {
            Some(all) => format!("the budget of {all} s (`--budget`)"),
            None => "the budget".to_owned(),
        }
    }
}

/// Variables of the joints that are in loops and couplings.
pub(crate) fn looped_variables(mechanism: &Mechanism, structure: &Structure) -> usize {
    let looped = structure.parts.iter().flat_map(|part| &part.joints);
    looped
        .map(|&joint| mechanism.joints()[joint].freedom())
        .sum()
}

/// How many wheels couplings of three joints and more are made of: one for each term.
pub(super) fn wheels(mechanism: &Mechanism) -> usize {
    let terms = mechanism.couplings().iter().map(|c| c.terms.len());
    terms.filter(|count| *count > 2).sum()
}

/// Seconds that a run of a motion with so many substeps takes.
pub(super) fn cost_of_run(
    size: &Size,
    motion: &DrivenMotion<'_>,
    time_step: f64,
    substeps: usize,
) -> f64 {
    let steps = motion.duration() / time_step;
    size.steps(steps, substeps) + size.looks(motion.moments().min(steps as usize) as f64)
}

/// Seconds that counting so many freedoms takes: a world is made for every blow and stepped until its velocities settle,
/// mostly within two steps, and where the count is not the one expected, three times over.
pub(super) fn cost_of_count(size: &Size, freedom: usize) -> f64 {
    let blows = freedom as f64 + 4.0;
    blows * size.steps(4.0, SUBSTEPS)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_fit_is_not_begun_and_smaller_work_still_is() {
        let mut budget = Budget::new(Some(10.0));
        assert!(budget.affords(6.0));
        assert!(!budget.affords(5.0));
        assert!(budget.affords(4.0));
        assert!(!budget.affords(0.1));
        assert!(Budget::new(None).affords(1e9));
    }

    #[test]
    fn wheels_of_couplings_count_as_bodies() {
        let text = |second: &str| {
            format!(
                r#"<robot name="arm"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
                <joint name="x" type="continuous"><parent link="a"/><child link="b"/></joint>
                <joint name="y" type="continuous"><parent link="b"/><child link="c"/></joint>
                <joint name="z" type="continuous"><parent link="a"/><child link="d"/></joint>
                <coupling name="gears"><predecessor link="d"/><successor link="{second}"/><ratio value="6"/></coupling></robot>"#
            )
        };
        let size = |second: &str| {
            let read =
                kutzbach_format::read_bytes(text(second).as_bytes(), "arm.urdf", &[]).unwrap();
            Size::of(&read.mechanism, 0)
        };
        // One joint on the way, and two: the third term makes a row of wheels.
        assert_eq!((size("b").bodies, size("b").variables), (4.0, 3.0));
        assert_eq!((size("c").bodies, size("c").variables), (7.0, 6.0));
    }

    #[test]
    fn many_ways_share_the_budget_and_few_are_not_cut_short() {
        let size = |size: f64| Size {
            bodies: size,
            variables: size,
            looped: size,
        };
        let of = |seconds: Option<f64>, large: f64, ways: usize| {
            Budget::new(seconds).longest(&size(large), ways, (1.0 / 60.0, &[4, 8, 16, 32]), 10.0)
        };
        assert_eq!(of(Some(30.0), 8.0, 3), 10.0);
        assert_eq!(of(None, 60.0, 30), 10.0);
        assert_eq!(of(Some(30.0), 60.0, 30), SHORTEST_TIME);
        let shared = of(Some(30.0), 40.0, 8);
        assert!(shared > SHORTEST_TIME && shared < 10.0, "{shared}");
        let run = shared * size(40.0).steps(60.0, 4 + 8 + 16);
        assert!(8.0 * run <= 30.0, "{run}");
        // No budget at all is no reason for a way of no length.
        assert_eq!(of(Some(0.0), 40.0, 8), SHORTEST_TIME);
    }

    #[test]
    fn large_loops_are_looked_at_less_often() {
        let size = |looped: f64| Size {
            bodies: 40.0,
            variables: 40.0,
            looped,
        };
        assert_eq!(size(6.0).moments(240), 240);
        assert_eq!(size(200.0).moments(240), FEWEST);
        assert_eq!(size(200.0).moments(5), 5);
    }
}
