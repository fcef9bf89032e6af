//! Unit-proof: the same mechanism described differently has the same answers.
//!
//! Every reference mechanism is analysed as it is and
//!
//! - (a) with all lengths a millionth and a million of what they were,
//! - (b) with the coordinates in every link turned by one rational rotation, and with the ground's own frame turned by it,
//! - (c) moved a thousand lengths from the origin: the frames in the ground, or every link's own frame,
//! - (d) with links and joints in another order and under other names, three times,
//! - (e) with other joints written as the loops, on a spanning tree grown from another link, three times,
//! - (f) with numbers of seventeen significant digits, and with numbers as programs print doubles.
//!
//! What must agree: the counts (Kutzbach, generic), the instantaneous freedom and what remains possible beside it, the
//! bounds and the verdict, regular or singular with its kind, the class, the branches with their dimensions, freedoms,
//! redundancies, half-branches and locked joints, what is locked and how many reaction directions are indeterminate joint by joint, which joints
//! are advised to be relaxed and with what gain, and the facts of every cycle that both descriptions list.
//!
//! What may differ: whether numbers with all digits of a double, taken literally, move as well (the last of these digits
//! decides that); whether a joint moves or a thin margin leaves that open (that it rests may not); the tree and the cycles listed, where ties are broken by name or by the place of the loops; the
//! direction in which a cycle is walked; the assembly's residual, in every digit; the smallest dropped singular value and
//! with it the gap, in every digit, since both are rounding; the last kept singular value from its seventh digit on where
//! the equations are the same ones (a, c, f and b for joints that have axes), and in every digit where other cycles, or a
//! ball's or a plane's other axes, make other equations with the same kernel.

use crate::support;

use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, AnalysisOptions, ExactBudget, Verdict, analyse};
use kutzbach::number::Number;
use std::collections::{BTreeMap, BTreeSet};
use support::rewrite::{self, Draft};
use support::{assert_none, decimal, in_parallel, zoo};

/// What is said of one joint.
#[derive(Clone, Debug, PartialEq)]
struct JointFacts {
    locked: Option<bool>,
    locked_parts: BTreeSet<String>,
    redundant_wrenches: Option<usize>,
}

/// Facts of a cycle, by the set of its joints.
type Cycles = BTreeMap<BTreeSet<String>, String>;

/// Everything that must not depend on how a mechanism is described.
struct Answers {
    whole: Vec<(&'static str, String)>,
    joints: BTreeMap<String, JointFacts>,
    cycles: Cycles,
    kept: Vec<f64>,
}

/// The analysis without exact algebra, which is asked about exact numbers only: those of a mechanism that was turned or
/// moved are rounded, so that what it decides depends on how the file is written, and rightly.
fn analysis(mechanism: &Mechanism) -> Analysis {
    let options = AnalysisOptions {
        exact: ExactBudget::none(),
        ..AnalysisOptions::default()
    };
    analyse(mechanism, &options).unwrap()
}

/// What is said of the branches, in an order that depends on nothing else.
fn branches(analysis: &Analysis, joint_name: &dyn Fn(usize) -> String) -> String {
    let Some(branches) = &analysis.branches else {
        return "open".to_owned();
    };
    let mut told: Vec<String> = branches
        .iter()
        .map(|branch| {
            let roles = branch.roles.iter().enumerate();
            let locked: BTreeSet<String> = roles
                .filter(|(_, role)| role.locked == Some(true))
                .map(|(joint, _)| joint_name(joint))
                .collect();
            format!(
                "dimension {}, instantaneous {:?}, redundant {:?}, half-branches {:?}, locked {locked:?}",
                branch.dimension, branch.instantaneous, branch.redundant, branch.half_branches
            )
        })
        .collect();
    told.sort();
    told.join("; ")
}

impl Answers {
    /// `names` leads from the joint names of the mechanism to those that the answers are told in.
    fn of(mechanism: &Mechanism, analysis: &Analysis, names: &dyn Fn(&str) -> String) -> Self {
        let joint_name = |joint: usize| names(&mechanism.joints()[joint].name);
        // `joint.rot` follows its joint's name; the names themselves may have points in them.
        let part_name = |part: &str| -> String {
            let joints = mechanism.joints().iter();
            joints
                .filter_map(|joint| {
                    let rest = part.strip_prefix(&joint.name)?;
                    (rest.is_empty() || rest.starts_with('.'))
                        .then(|| format!("{}{rest}", names(&joint.name)))
                })
                .max_by_key(String::len)
                .unwrap()
        };
        let home = analysis.home.as_ref();
        let mobility = &analysis.mobility;
        let mut advice: Vec<String> = analysis
            .advice
            .iter()
            .map(|a| {
                format!(
                    "{} to {} leaves {}",
                    joint_name(a.joint),
                    a.to,
                    a.redundant_after
                )
            })
            .collect();
        advice.sort();
        let whole = vec![
            ("closed", analysis.assembly.closed.to_string()),
            ("kutzbach", analysis.kutzbach.to_string()),
            ("generic", format!("{:?}", analysis.generic)),
            (
                "instantaneous",
                format!("{:?}", home.map(|h| h.instantaneous)),
            ),
            ("candidates", format!("{:?}", home.map(|h| h.candidates))),
            ("as written", format!("{:?}", home.map(|h| h.as_written))),
            ("redundant", format!("{:?}", home.map(|h| h.redundant))),
            ("verdict", mobility.verdict.word().to_owned()),
            ("bounds", format!("{:?}", mobility.bounds)),
            ("pose", format!("{:?}", mobility.pose)),
            ("kind", format!("{:?}", mobility.kind)),
            ("class", format!("{:?}", mobility.class)),
            ("branches", branches(analysis, &joint_name)),
            ("advice", advice.join(", ")),
            (
                "reservations",
                analysis
                    .parts
                    .iter()
                    .filter(|p| p.note.is_some())
                    .count()
                    .to_string(),
            ),
        ];
        let joints = (0..mechanism.joints().len())
            .map(|joint| {
                let role = &analysis.roles[joint];
                let facts = JointFacts {
                    locked: role.locked,
                    locked_parts: role.locked_parts.iter().map(|p| part_name(p)).collect(),
                    redundant_wrenches: analysis.redundant_wrenches[joint],
                };
                (joint_name(joint), facts)
            })
            .collect();
        let cycles = analysis
            .cycles
            .iter()
            .map(|cycle| {
                let joints = cycle
                    .joints
                    .iter()
                    .map(|(joint, _)| joint_name(*joint))
                    .collect();
                let locks: BTreeSet<String> = cycle.locks.iter().map(|p| part_name(p)).collect();
                let facts = format!(
                    "space {:?}, rank {:?}, redundant {:?}, mobility {:?}, locks {locks:?}",
                    cycle.space_dimension, cycle.rank, cycle.redundant, cycle.mobility
                );
                (joints, facts)
            })
            .collect();
        let mut kept: Vec<f64> = analysis
            .parts
            .iter()
            .map(|part| part.decision.kept)
            .collect();
        kept.sort_by(f64::total_cmp);
        Self {
            whole,
            joints,
            cycles,
            kept,
        }
    }

    fn differences(&self, other: &Self, kept_agrees: bool) -> Vec<String> {
        let mut wrong = Vec::new();
        for ((what, mine), (_, theirs)) in self.whole.iter().zip(&other.whole) {
            if mine != theirs {
                wrong.push(format!("{what}: {mine} became {theirs}"));
            }
        }
        assert_eq!(self.joints.len(), other.joints.len());
        for (joint, mine) in &self.joints {
            let mut theirs = other.joints[joint].clone();
            // Whether a joint moves a little or a thin margin leaves that open may change; that it rests may not.
            let open_or_moving = |locked| locked != Some(true);
            if open_or_moving(mine.locked) && open_or_moving(theirs.locked) {
                theirs.locked = mine.locked;
            }
            if *mine != theirs {
                wrong.push(format!("joint {joint}: {mine:?} became {theirs:?}"));
            }
        }
        for (joints, mine) in &self.cycles {
            if let Some(theirs) = other.cycles.get(joints).filter(|theirs| *theirs != mine) {
                wrong.push(format!("cycle {joints:?}: {mine} became {theirs}"));
            }
        }
        if kept_agrees {
            for (mine, theirs) in self.kept.iter().zip(&other.kept) {
                if !((mine - theirs).abs() <= KEPT_AGREES * mine) {
                    wrong.push(format!("kept singular value: {mine:e} became {theirs:e}"));
                }
            }
        }
        wrong
    }
}

/// Relative difference allowed between the kept singular values of equations that are the same ones. Rounding, also that of
/// coordinates of a few thousand metres, moves singular values by some 1e-13 of the largest; the smallest one kept in the
/// collection is 2e-7 of it (a Bennett loop perturbed by a millionth), all others are above 1e-4.
const KEPT_AGREES: f64 = 1e-6;

/// Verdicts that a rewriting leaves open. In this mechanism the branches are multiple zeros of equations of the fourth order,
/// and coordinates of some thousand metres leave four digits less to find them with.
const LEFT_OPEN: [(&str, &str); 2] = [
    ("wren_platform_6US", "far from the origin"),
    ("wren_platform_6US", "with far link frames"),
];

fn analysis_is_open(mechanism: &Mechanism) -> bool {
    analysis(mechanism).mobility.verdict == Verdict::Undecided
}

/// How a mechanism was rewritten, the rewriting, and the new names of its joints where they have any.
type Rewritten = (String, Draft, BTreeMap<String, String>);

/// Compares every reference mechanism, prepared in some way, with its rewritings.
fn compare(
    prepare: &(dyn Fn(Draft) -> Draft + Sync),
    kept_agrees: &(dyn Fn(&Mechanism) -> bool + Sync),
    rewritings: &(dyn Fn(&Draft) -> Vec<Rewritten> + Sync),
) {
    let wrong = in_parallel(&support::sample(zoo(), 3), |(name, mechanism)| {
        let same = |n: &str| n.to_owned();
        let draft = prepare(Draft::of(mechanism));
        let prepared = draft.build();
        let answers = Answers::of(&prepared, &analysis(&prepared), &same);
        let mut wrong = Vec::new();
        for (how, draft, new_names) in rewritings(&draft) {
            let old_names: BTreeMap<&str, &str> = new_names
                .iter()
                .map(|(old, new)| (new.as_str(), old.as_str()))
                .collect();
            let names = |n: &str| old_names.get(n).copied().unwrap_or(n).to_owned();
            let rewritten = draft.build();
            let other = Answers::of(&rewritten, &analysis(&rewritten), &names);
            let differences = answers.differences(&other, kept_agrees(mechanism));
            if LEFT_OPEN.contains(&(name.as_str(), how.as_str())) && analysis_is_open(&rewritten) {
                continue;
            }
            wrong.extend(differences.iter().map(|d| format!("{name}, {how}: {d}")));
        }
        wrong
    });
    assert_none(&wrong.concat());
}

fn as_drawn(draft: Draft) -> Draft {
    draft
}

/// With numbers that state no precision: a turned coordinate is no decimal any more, so it cannot state what the original
/// did.
fn exact(draft: Draft) -> Draft {
    draft.each_number(&decimal::exact)
}

fn plain(how: &str, draft: Draft) -> Rewritten {
    (how.to_owned(), draft, BTreeMap::new())
}

/// Whether every freedom has an axis of its own, so that the Jacobian's columns do not depend on how frames lie.
fn has_axes_only(mechanism: &Mechanism) -> bool {
    mechanism.joints().iter().all(|joint| {
        use kutzbach::mechanism::JointKind as K;
        matches!(
            joint.kind,
            K::Fixed | K::Revolute | K::Prismatic | K::Screw | K::Cylindrical | K::Universal
        )
    })
}

fn has_one_loop(mechanism: &Mechanism) -> bool {
    mechanism.joints().len() == mechanism.links().len()
}

/// Whether a file with the digits of a program leaves its rank open for that reason. Then it has to be undecided: two
/// confident answers that differ are never right.
fn hangs_on_its_digits(draft: &Draft) -> bool {
    let found = analysis(&draft.build());
    let doubtful = found.parts.iter().any(|part| part.doubt.is_some());
    assert!(!doubtful || found.mobility.finite().is_none());
    doubtful
}

/// Axes that meet in a point leave a loop without a length of its own; what is left of its coordinates is noise, such as
/// programs write for zero.
#[test]
fn noise_in_coordinates_is_no_length() {
    let sphere = |noise: [&str; 4]| {
        let [a, b, c, d] = noise;
        format!(
            r#"<robot name="spherical"> <link name="g"/> <link name="1"/> <link name="2"/> <link name="3"/> <link name="arm"/>
<joint name="J1" type="revolute"><parent link="g"/><child link="1"/><origin xyz="0 {a} 0"/><axis xyz="0 0 1"/></joint>
<joint name="J2" type="revolute"><parent link="1"/><child link="2"/><origin xyz="{b} 0 {a}"/><axis xyz="0.6 0 0.8"/></joint>
<joint name="J4" type="revolute"><parent link="g"/><child link="3"/><origin xyz="{c} 0 {d}"/><axis xyz="0 0.8 0.6"/></joint>
<loop name="J3" type="revolute">
  <predecessor link="2"><origin xyz="{d} {c} 0"/></predecessor> <successor link="3"><origin xyz="0 {b} {c}"/></successor>
  <axis xyz="0.48 0.64 0.6"/>
</loop>
<joint name="A" type="revolute"><parent link="g"/><child link="arm"/><origin xyz="1 2 3"/><axis xyz="0 0 1"/></joint>
</robot>"#
        )
    };
    let mut wrong = Vec::new();
    for noise in [
        ["0", "0", "0", "0"],
        ["1.2e-17", "-5.5e-17", "3.3e-18", "2.7e-17"],
        [
            "1.22464679914735e-16",
            "-5.55111512312578e-17",
            "2e-17",
            "-6.1e-17",
        ],
        ["2.1e-41", "-1.3e-41", "4.2e-41", "-0.7e-41"],
    ] {
        let mechanism = kutzbach::format::read(&sphere(noise), "spherical", &[])
            .unwrap()
            .mechanism;
        let analysis = analysis(&mechanism);
        let instantaneous = analysis.home.as_ref().map(|h| h.instantaneous);
        let rank = analysis.cycles.first().map(|cycle| cycle.rank);
        if (instantaneous, rank) != (Some(Some(2)), Some(Some(3))) {
            wrong.push(format!(
                "noise {noise:?}: closed {}, instantaneous {instantaneous:?}, rank of the cycle {rank:?}",
                analysis.assembly.closed
            ));
        }
    }
    assert_none(&wrong);
}

#[test]
fn digits_move_and_round() {
    let number = |text: &str| Number::decimal(text).unwrap();
    let shift = |text, by| decimal::shifted(&number(text), by).source();
    assert_eq!(shift("-0.125", 1), "-1.25");
    assert_eq!(shift("0.125", -6), "0.000000125");
    assert_eq!(shift("0.125", 6), "125000");
    assert_eq!(shift("12", -1), "1.2");
    assert_eq!(shift("0", 6), "0");
    let fixed = |text, n| decimal::with_decimals(&number(text), n).source();
    assert_eq!(fixed("0.99996", 4), "1.0000");
    assert_eq!(fixed("-0.00004", 4), "0.0000");
    assert_eq!(fixed("2", 3), "2.000");
    assert_eq!(fixed("0", 3), "0.000");
    assert_eq!(fixed("0.5", 3), "0.500");
    assert_eq!(fixed("9.96", 1), "10.0");
    assert_eq!(fixed("0.05", 1), "0.1");
    let short = |text, n| decimal::with_decimals_stripped(&number(text), n).source();
    assert_eq!(short("0.49999999", 4), "0.5");
    assert_eq!(short("100", 4), "100");
    let added = |a, b| decimal::sum(&number(a), &number(b)).source();
    assert_eq!(added("0.125", "-1.2"), "-1.075");
    assert_eq!(added("0.12", "-0.12"), "0.00");
    assert_eq!(added("1500", "0.001"), "1500.001");
    assert_eq!(decimal::negated(&number("0.50")).source(), "-0.50");
    assert!(decimal::exact(&number("0.50")).stated().is_none());
    let significant = |text, n| decimal::with_significant(&number(text), n).source();
    assert_eq!(significant("0.0012345", 3), "0.00123");
    assert_eq!(significant("123456", 3), "123000");
    assert_eq!(significant("0.9999", 2), "1");
    assert_eq!(decimal::as_a_double(&number("0.0000003")).source(), "3e-7");
}

#[test]
fn the_turn_is_a_rotation() {
    for i in 0..3 {
        for j in 0..3 {
            let dot: i64 = (0..3)
                .map(|k| rewrite::TURN[i][k] * rewrite::TURN[j][k])
                .sum();
            assert_eq!(dot, if i == j { 225 } else { 0 });
        }
    }
    let [a, b, c] = rewrite::TURN;
    let determinant = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0]);
    assert_eq!(determinant, 15 * 15 * 15);
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn e_which_joints_are_loops_does_not_matter() {
        let kept_agrees =
            |mechanism: &Mechanism| has_one_loop(mechanism) && has_axes_only(mechanism);
        compare(&as_drawn, &kept_agrees, &|draft| {
            (1..=3)
                .map(|seed| {
                    plain(
                        &format!("tree {seed}"),
                        draft.clone().with_another_tree(seed),
                    )
                })
                .collect()
        });
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn f_digits_beyond_a_double_do_not_matter() {
        let cut =
            |draft: &Draft, change: &dyn Fn(&Number) -> Number| draft.clone().each_number(change);
        compare(&as_drawn, &|_| true, &|draft| {
            vec![
                plain(
                    "17 digits",
                    cut(draft, &|n| decimal::with_significant(n, 17)),
                ),
                plain("doubles", cut(draft, &decimal::as_a_double)),
                plain("doubles in full", cut(draft, &decimal::as_a_double_in_full)),
            ]
            .into_iter()
            .filter(|(_, draft, _)| !hangs_on_its_digits(draft))
            .collect()
        });
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn a_the_unit_of_length_does_not_matter() {
        compare(&as_drawn, &|_| true, &|draft| {
            [-6, -3, 3, 6]
                .map(|e| plain(&format!("lengths times 1e{e}"), draft.clone().scaled(e)))
                .into()
        });
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn b_how_the_mechanism_is_turned_does_not_matter() {
        compare(&exact, &has_axes_only, &|draft| {
            vec![
                plain("turned", draft.clone().turned()),
                plain("on a turned ground", draft.clone().ground_turned()),
            ]
        });
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn c_where_the_mechanism_stands_does_not_matter() {
        // The mechanisms are some 1 to 10 m large: three thousand metres is a thousand lengths and more.
        let by = [1500, -2600, 777].map(Number::integer);
        compare(&as_drawn, &|_| true, &|draft| {
            vec![
                plain("far from the origin", draft.clone().ground_moved(&by)),
                plain("with far link frames", draft.clone().frames_moved(&by)),
            ]
        });
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn d_order_and_names_do_not_matter() {
        let kept_agrees =
            |mechanism: &Mechanism| has_one_loop(mechanism) && has_axes_only(mechanism);
        compare(&as_drawn, &kept_agrees, &|draft| {
            (1..=3)
                .map(|seed| {
                    let (shuffled, names) = draft.clone().shuffled(seed);
                    (format!("shuffled {seed}"), shuffled, names)
                })
                .collect()
        });
    }
}
