//! Derivatives and what rests on them: the Jacobian against finite differences of the residual, the order of convergence of
//! assembly, and the digits that polishing reaches.

use crate::support;

use kutzbach::closure::{
    Arithmetic, CycleJacobian, Geometry, JointState, Part, Rigid, WalkedCycle, assemble, jacobian,
    refine,
};
use kutzbach::matrix::{Extended, LeastSquares, Real, SplitMix64};
use kutzbach::mechanism::{Direction, Frame, JointBuilder, JointKind, Mechanism, MechanismBuilder};
use kutzbach::mobility::Structure;
use kutzbach::number::Number;
use proptest::prelude::*;
use std::collections::BTreeSet;
use support::{in_parallel, own_mechanisms, zoo_mechanism};

fn vector(random: &mut SplitMix64, size: f64) -> [f64; 3] {
    [0; 3].map(|_| size * random.symmetric())
}

/// A rigid displacement with any rotation.
fn displacement(random: &mut SplitMix64) -> Rigid<f64> {
    let turned = Rigid::exponential(&vector(random, 3.0), &[0.0; 3]);
    Rigid::translation(vector(random, 2.0)).compose(&turned)
}

/// One closed loop of the given kinds in random places at a random state: frames, axes, leads and values are random, and the
/// last joint's frame in its successor is put where the loop closes. Two joints of one freedom, if there are, are coupled.
fn closed_loop(kinds: &[JointKind], seed: u64) -> (Mechanism, Geometry<f64>, Part) {
    let mut random = SplitMix64::new(seed);
    let count = kinds.len();
    let mut builder = MechanismBuilder::new("loop");
    let link = |index: usize| format!("link_{}", index % count);
    for index in 0..count {
        builder.link(&link(index));
    }
    for (index, &kind) in kinds.iter().enumerate() {
        let mut direction = || Direction::of(vector(&mut random, 1.0)).unwrap();
        let (axis, axis2) = (direction(), direction());
        let last = index + 1 == count;
        let make = if last {
            JointBuilder::closing
        } else {
            JointBuilder::tree
        };
        // Half of the joints are passed backward.
        let name = format!("joint_{index}");
        let ends = [link(index), link(index + 1)];
        let mut joint = make(&name, kind, &ends[0], &ends[1]);
        if last && seed.is_multiple_of(2) {
            joint = make(&name, kind, &ends[1], &ends[0]);
        }
        if kind.uses_axis() {
            joint = joint.axis(axis);
        }
        if kind.uses_second_axis() {
            joint = joint.axis2(axis2);
        }
        if kind.uses_lead() {
            joint = joint.lead(Number::from_f64(3.0 * random.symmetric()).unwrap());
        }
        if kind == JointKind::Distance {
            joint = joint.distance(Number::from_f64(1.5 + random.symmetric()).unwrap());
        }
        builder.joint(joint.origin(Frame::identity()));
    }
    let single: Vec<usize> = (0..count).filter(|i| kinds[*i].freedom() == 1).collect();
    if let [first, second, ..] = single.as_slice() {
        let offset = Number::from_f64(random.symmetric()).unwrap();
        let multiplier = Number::from_f64(-2.5).unwrap();
        let (first, second) = (format!("joint_{first}"), format!("joint_{second}"));
        if seed.is_multiple_of(3) {
            let cubic = Number::from_f64(0.75).unwrap();
            let terms = vec![
                (first, 1, Number::one()),
                (second.clone(), 1, multiplier),
                (second, 3, cubic),
            ];
            builder.polynomial_coupling("cam", terms, offset);
        } else {
            builder.mimic(&first, &second, multiplier, offset);
        }
    }
    let mechanism = builder.build().unwrap();
    let structure = Structure::new(&mechanism);
    let part = structure.parts[0].clone();
    let mut geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
    for index in 0..count {
        geometry.sides[index] = [displacement(&mut random), displacement(&mut random)];
        let joint = &geometry.displacements[index];
        let values: Vec<f64> = (0..joint.freedom())
            .map(|_| 3.0 * random.symmetric())
            .collect();
        geometry.states[index] = joint.at(&values);
    }
    for coupling in &mut geometry.couplings {
        let (open, _) = coupling.at(&geometry.states);
        coupling.offset += open;
    }
    // Going round leaves T; the last joint's far side takes it up: (…)·F with F closing.
    let cycle = &part.cycles[0];
    let start = cycle
        .iter()
        .position(|(joint, _)| *joint == count - 1)
        .unwrap();
    let mut rotated = cycle.clone();
    rotated.rotate_left((start + 1) % count);
    let around = WalkedCycle::walk(&geometry, &geometry.states, &rotated).closure;
    let (joint, forward) = rotated[count - 1];
    if forward {
        // around = A·S⁻¹ with S the successor side; S becomes A = around·S.
        geometry.sides[joint][1] = around.compose(&geometry.sides[joint][1]);
    } else {
        geometry.sides[joint][0] = around.compose(&geometry.sides[joint][0]);
    }
    (mechanism, geometry, part)
}

/// The derivative of the residual by central differences, one column per variable, in the Jacobian's units.
fn differences(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    part: &Part,
    here: &CycleJacobian<f64>,
    step: f64,
) -> Vec<Vec<f64>> {
    let residual_at = |joint: usize, variable: usize, by: f64| {
        let mut states = geometry.states.clone();
        let mut increments = vec![0.0; geometry.displacements[joint].freedom()];
        increments[variable] = by;
        geometry.displacements[joint].advance(&mut states[joint], &increments);
        let there = jacobian(mechanism, geometry, &states, part).unwrap();
        // A cycle's own length follows the pose, and not smoothly; the derivative is that of the displacement in metres.
        let mut residual = there.residual.clone();
        let ratio = there.walks[0].length / here.walks[0].length;
        residual[3..6].iter_mut().for_each(|r| *r *= ratio);
        // So does the weight of a coupling's row.
        if let [_, _, _, _, _, _, coupling] = residual.as_mut_slice() {
            *coupling *= coupling_weight(geometry, &there) / coupling_weight(geometry, here);
        }
        residual
    };
    here.variables
        .iter()
        .enumerate()
        .map(|(column, &(joint, variable))| {
            let unit = here.unit(mechanism, column);
            let forth = residual_at(joint, variable, step * unit);
            let back = residual_at(joint, variable, -step * unit);
            forth
                .iter()
                .zip(&back)
                .map(|(a, b)| (a - b) / (2.0 * step))
                .collect()
        })
        .collect()
}

/// What the row of the coupling was divided by.
fn coupling_weight(geometry: &Geometry<f64>, jacobian: &CycleJacobian<f64>) -> f64 {
    geometry.couplings[0].norm(|joint| geometry.coupled_unit(joint, jacobian.length))
}

fn assert_derivative(kinds: &[JointKind], seed: u64) {
    let (mechanism, geometry, part) = closed_loop(kinds, seed);
    let here = jacobian(&mechanism, &geometry, &geometry.states, &part).unwrap();
    let walk = &here.walks[0];
    let spread = 1.0 + walk.reach / walk.length;
    let cycle_residual = here.residual[..6]
        .iter()
        .fold(0.0f64, |m, x| m.max(x.abs()));
    assert!(
        cycle_residual < 1e-13 * spread,
        "closed to {cycle_residual:e}"
    );
    // Truncation is of the order of step² = 1e-10 times third derivatives, rounding 1e-16/step = 1e-11; both are multiplied
    // by how far coordinates reach beyond the cycle's own length.
    let step = 1e-5;
    let allowed = 1e-8 * spread.powi(2);
    let numeric = differences(&mechanism, &geometry, &part, &here, step);
    let mut exact = vec![vec![0.0; here.matrix.rows()]; here.matrix.columns()];
    for (row, column, entry) in here.matrix.triplets() {
        exact[column][row] += entry;
    }
    for (column, (numeric, exact)) in numeric.iter().zip(&exact).enumerate() {
        for (row, (n, e)) in numeric.iter().zip(exact).enumerate() {
            assert!(
                (n - e).abs() <= allowed,
                "row {row}, variable {:?} of {kinds:?}: {e} by screws, {n} by differences",
                here.variables[column]
            );
        }
    }
}

#[test]
fn every_kind_of_joint_has_the_right_screws() {
    for kind in JointKind::ALL {
        for seed in 0..20 {
            assert_derivative(
                &[kind, JointKind::Revolute, kind, JointKind::Prismatic],
                seed,
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_jacobian_is_the_derivative_of_the_residual(
        kinds in prop::collection::vec(prop::sample::select(JointKind::ALL.to_vec()), 2..8),
        seed in any::<u64>(),
    ) {
        // A loop of fixed joints alone has nothing to differentiate.
        prop_assume!(kinds.iter().any(|kind| kind.freedom() > 0));
        assert_derivative(&kinds, seed);
    }
}

/// Mechanisms at regular poses, under- and overconstrained, one loop and several, all sorts of joints. Kinematotropic ones
/// and others whose rank changes nearby are left out: there convergence is linear.
const REGULAR: [&str; 14] = [
    "bennett_generic",
    "bricard_orthogonal",
    "delta_3RRPaR",
    "general_7r",
    "goldberg_5r_L",
    "miura_2x2",
    "oldham_rccr",
    "planar_3RRR",
    "rccc",
    "rssr",
    "sarrus_6r",
    "spherical_4r",
    "stewart_6UPS",
    "tripteron_3PRRR",
];

/// Moves every variable by up to `size` (rad, or part lengths).
fn perturb(
    mechanism: &Mechanism,
    geometry: &mut Geometry<f64>,
    parts: &[Part],
    size: f64,
    seed: u64,
) {
    let mut random = SplitMix64::new(seed);
    for part in parts {
        let here = jacobian(mechanism, geometry, &geometry.states, part).unwrap();
        let increments: Vec<f64> = here
            .variables
            .iter()
            .map(|_| size * random.symmetric())
            .collect();
        advance(mechanism, geometry, &here, &increments);
    }
}

fn advance(
    mechanism: &Mechanism,
    geometry: &mut Geometry<f64>,
    here: &CycleJacobian<f64>,
    increments: &[f64],
) {
    let mut states: Vec<JointState<f64>> = geometry.states.clone();
    let mut column = 0;
    while column < here.variables.len() {
        let (joint, _) = here.variables[column];
        let freedom = geometry.displacements[joint].freedom();
        let values: Vec<f64> = (column..column + freedom)
            .map(|c| increments[c] * here.unit(mechanism, c))
            .collect();
        geometry.displacements[joint].advance(&mut states[joint], &values);
        column += freedom;
    }
    geometry.states = states;
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Residuals of damped Gauss–Newton from a perturbed pose, the damping being the squared residual.
fn residuals(mechanism: &Mechanism, seed: u64) -> Vec<f64> {
    let structure = Structure::new(mechanism);
    let mut geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    perturb(mechanism, &mut geometry, &structure.parts, 0.05, seed);
    let part = &structure.parts[0];
    let mut found = Vec::new();
    for _ in 0..12 {
        let here = jacobian(mechanism, &geometry, &geometry.states, part).unwrap();
        let residual = norm(&here.residual);
        found.push(residual);
        if residual < 1e-14 {
            break;
        }
        let right: Vec<f64> = here.residual.iter().map(|r| -r).collect();
        let increments =
            LeastSquares::damped(&here.matrix, &right, residual * residual, None).unwrap();
        advance(mechanism, &mut geometry, &here, &increments);
    }
    found
}

#[test]
fn gauss_newton_converges_quadratically_at_regular_poses() {
    let wrong = in_parallel(&REGULAR, |name| {
        let mechanism = zoo_mechanism(name);
        let mut wrong = Vec::new();
        for seed in 1..=4 {
            let residuals = residuals(&mechanism, seed);
            // r′ = r^order, near the solution and above rounding: r′ = C r² with C up to 10 makes 1.8 of 1e-5, a residual
            // that falls to a tenth each time 1.2.
            let orders: Vec<f64> = residuals
                .windows(2)
                .filter(|w| w[0] < 0.01 && w[1] > 1e-13)
                .map(|w| w[1].ln() / w[0].ln())
                .collect();
            let last = residuals.last().copied().unwrap();
            if !(last < 1e-13) || !orders.last().is_some_and(|order| *order >= 1.8) {
                wrong.push(format!(
                    "{name}, seed {seed}: orders {orders:.2?}, {residuals:?}"
                ));
            }
        }
        wrong
    });
    support::assert_none(&wrong.concat());
}

#[test]
fn assembly_closes_perturbed_mechanisms_in_a_few_steps() {
    let wrong = in_parallel(&REGULAR, |name| {
        let mechanism = zoo_mechanism(name);
        let structure = Structure::new(&mechanism);
        let mut wrong = Vec::new();
        for seed in 1..=4 {
            let mut geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
            perturb(&mechanism, &mut geometry, &structure.parts, 0.05, seed);
            let assembly =
                assemble(&mechanism, &geometry, &structure.parts, &BTreeSet::new()).unwrap();
            // From 0.05, squaring each time: 4 steps to rounding, and a few until that sets in. Halving would take 40.
            let most = 12 * structure.parts.len();
            if !assembly.closed || assembly.residual > 1e-12 || assembly.steps > most {
                wrong.push(format!(
                    "{name}, seed {seed}: {} steps to {:.1e}",
                    assembly.steps, assembly.residual
                ));
            }
        }
        wrong
    });
    support::assert_none(&wrong.concat());
}

/// Mechanisms with exact numbers, moved away from where they are drawn: closed in double precision, then polished.
#[test]
fn polishing_reaches_the_last_digits() {
    const BITS: u32 = 212;
    const NAMES: [&str; 9] = [
        "bennett",
        "bricard_line_symmetric",
        "gripper",
        "oldham",
        "planar_four_bar",
        "rssr",
        "sarrus",
        "slider_crank",
        "stewart",
    ];
    let mechanisms: Vec<(String, Mechanism)> = own_mechanisms()
        .into_iter()
        .filter(|(name, _)| NAMES.contains(&name.as_str()))
        .collect();
    assert_eq!(mechanisms.len(), NAMES.len());
    let wrong = in_parallel(&mechanisms, |(name, mechanism)| {
        let structure = Structure::new(mechanism);
        let held = BTreeSet::new();
        let mut geometry = Geometry::new(mechanism, None, &Arithmetic::double());
        perturb(mechanism, &mut geometry, &structure.parts, 0.05, 5);
        let assembly = assemble(mechanism, &geometry, &structure.parts, &held).unwrap();
        let precise = Geometry::new(mechanism, None, &Arithmetic::bits(BITS));
        let mut states: Vec<JointState<Extended>> = precise
            .displacements
            .iter()
            .zip(geometry.displacements.iter().zip(&assembly.states))
            .map(|(displacement, (double, state))| displacement.adopt(double, state))
            .collect();
        let mut wrong = Vec::new();
        for part in &structure.parts {
            let before = jacobian(mechanism, &precise, &states, part).unwrap();
            let double: Vec<f64> = before.residual.iter().map(Real::to_f64).collect();
            let reached = refine(mechanism, &precise, &mut states, part, &held).unwrap();
            let after = jacobian(mechanism, &precise, &states, part).unwrap();
            let left: Vec<f64> = after.residual.iter().map(Real::to_f64).collect();
            if !(norm(&double) > 1e-25) {
                wrong.push(format!(
                    "{name}: the pose was exact before, which tests nothing"
                ));
            }
            if !(assembly.closed && reached < 1e-60 && norm(&left) < 1e-60) {
                wrong.push(format!(
                    "{name}: from {:.1e} to {reached:.1e}",
                    norm(&double)
                ));
            }
        }
        wrong
    });
    support::assert_none(&wrong.concat());
}
