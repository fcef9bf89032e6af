//! Three ways to the basis give one answer, relations are judged in any order, variables are ordered as asked.

use crate::support::folder;
use kutzbach::algebra::{
    Budget, ExactAnswer, ExactOptions, Formulation, Limits, Method, MonomialOrder, Polynomial,
    RelationVerdict, Stop, SystemOptions, accepted_at_home, exact_answer, groebner_basis,
    radical_contains, relation_by_relation, relations_of,
};
use kutzbach::format::read_file;
use kutzbach::mechanism::Mechanism;

fn mechanism(file: &str) -> Mechanism {
    read_file(folder(file), &[]).unwrap().mechanism
}

fn by(file: &str, method: Method) -> ExactAnswer {
    let options = ExactOptions {
        method: Some(method),
        ..ExactOptions::default()
    };
    let budget = Budget::new(Limits::seconds(300.0));
    let answer = exact_answer(&mechanism(file), &options, &budget).unwrap();
    assert_eq!(answer.stopped, None, "{file}");
    answer
}

/// What is asked of every way: basis, free variables, fixed ones, pieces.
fn told(answer: &ExactAnswer) -> [Vec<String>; 4] {
    let names = answer.system.names();
    let texts =
        |all: &[Polynomial]| -> Vec<String> { all.iter().map(|p| p.text(&names)).collect() };
    let basis = answer.basis.as_ref().unwrap();
    let named = |set: &Vec<usize>| {
        set.iter()
            .map(|&v| names[v].clone())
            .collect::<Vec<_>>()
            .join(", ")
    };
    let pieces = answer
        .pieces
        .iter()
        .map(|piece| texts(&piece.component.equations).join(", "));
    [
        texts(basis.polynomials()),
        answer.free.iter().map(named).collect(),
        answer
            .fixed
            .iter()
            .map(|fixed| names[fixed.variable].clone())
            .collect(),
        pieces.collect(),
    ]
}

#[test]
fn three_ways_one_answer() {
    for file in [
        "tests/thesis/double_peg.urdf",
        "tests/thesis/three_bodies.urdf",
        "tests/thesis/block_and_corner.urdf",
        "tests/thesis/thomas_torras_offset.urdf",
        "mechanisms/parallelogram.urdf",
        "mechanisms/oldham.urdf",
        "mechanisms/bennett.urdf",
    ] {
        let brute = told(&by(file, Method::Brute));
        assert_eq!(told(&by(file, Method::Divide)), brute, "{file}");
        assert_eq!(told(&by(file, Method::Incremental)), brute, "{file}");
    }
}

/// Table 6.15: the quarter turns and the places that the cycles of the Cartesian table put into what follows, in the cases that
/// they leave; eight at the end.
#[test]
fn what_the_cycles_of_the_table_put_into_what_follows() {
    let answer = by("tests/thesis/cartesian_table.urdf", Method::Incremental);
    assert_eq!((answer.dimension, answer.pieces.len()), (Some(Some(3)), 8));
    assert!(!answer.free.is_empty() && answer.free.iter().all(|set| set.len() == 3));
    let names = answer.system.names();
    let cases = answer.cases.as_ref().unwrap();
    assert_eq!(cases.combinations(), 8);
    let said = |wanted: &str, value: &str| {
        cases.learned.iter().any(|cycle| {
            !cycle.cases.is_empty()
                && cycle.cases.iter().all(|case| {
                    case.iter()
                        .any(|i| names[i.variable] == wanted && i.value.text(&names) == value)
                })
        })
    };
    // x8 = x9 = 2 and θ8 = θ9 = 0 by the cycles of two joints, θ5 = −90°, θ6 = 90°.
    for (name, value) in [
        ("C8.trans", "2"),
        ("C9.trans", "2"),
        ("sin(C8.rot)", "0"),
        ("sin(C9.rot)", "0"),
        ("C5.trans", "1"),
        ("C6.trans", "-1"),
        ("sin(C5.rot)", "-1"),
        ("sin(C6.rot)", "1"),
    ] {
        assert!(said(name, value), "{name} = {value}: {:?}", cases.learned);
    }
}

/// (5.7) as it is printed has forty polynomials, in the order of variables of the source.
#[test]
fn the_printed_order_of_variables_gives_the_printed_size() {
    let mut order = Vec::new();
    for n in 1..=4 {
        order.extend(
            [
                "cos(C{}.rot2)",
                "sin(C{}.rot2)",
                "C{}.trans2",
                "C{}.trans1",
                "cos(C{}.rot1)",
                "sin(C{}.rot1)",
            ]
            .map(|v| v.replace("{}", &n.to_string())),
        );
    }
    for n in 5..=9 {
        order.extend(["sin(C{}.rot)", "cos(C{}.rot)"].map(|v| v.replace("{}", &n.to_string())));
        match n {
            7 => order.extend(["C7.trans1", "C7.trans2"].map(str::to_owned)),
            _ => order.push(format!("C{n}.trans")),
        }
    }
    let file = "tests/thesis/cartesian_table.urdf";
    let options = ExactOptions {
        variable_order: order.clone(),
        ..ExactOptions::default()
    };
    let budget = Budget::new(Limits::seconds(300.0));
    let answer = exact_answer(&mechanism(file), &options, &budget).unwrap();
    let ordered = answer.ordered.unwrap();
    let names = answer.system.names();
    assert_eq!(
        ordered
            .variables
            .iter()
            .map(|&v| names[v].clone())
            .collect::<Vec<_>>(),
        order
    );
    assert_eq!(ordered.basis.polynomials().len(), 40);
    let unknown = ExactOptions {
        variable_order: vec!["nobody".to_owned()],
        ..ExactOptions::default()
    };
    assert!(exact_answer(&mechanism(file), &unknown, &budget).is_err());
}

/// An order of so many, by a generator of Lehmer's kind.
fn shuffled(count: usize, seed: &mut u64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    for last in (1..count).rev() {
        *seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        order.swap(last, (*seed >> 33) as usize % (last + 1));
    }
    order
}

/// The verdict on a relation from the ideals of all equations at once: no loops, no blocks, no dimensions.
fn independent(
    before: &[Polynomial],
    new: &[Polynomial],
    variables: usize,
    budget: &Budget,
) -> Result<RelationVerdict, Stop> {
    let all = [before, new].concat();
    if groebner_basis(&all, variables, &MonomialOrder::Degrevlex, budget)?.is_inconsistent() {
        return Ok(RelationVerdict::Inconsistent);
    }
    let before = groebner_basis(before, variables, &MonomialOrder::Degrevlex, budget)?;
    for equation in new {
        if !before.normal_form(equation).is_zero()
            && !radical_contains(before.polynomials(), variables, equation, budget)?
        {
            return Ok(RelationVerdict::Accepted);
        }
    }
    Ok(RelationVerdict::Redundant)
}

/// Judges a file's relations in random orders; how many verdicts were compared, and how many of them say that a relation is not
/// accepted.
fn compared(file: &str, orders: usize, seed: &mut u64) -> (usize, usize) {
    let options = SystemOptions {
        formulation: Formulation::Positional,
        ..SystemOptions::default()
    };
    let (_, given) = relations_of(&mechanism(file), &options).unwrap();
    let names: Vec<String> = given.relations.iter().map(|own| own.name.clone()).collect();
    let (mut all, mut refused) = (0, 0);
    for _ in 0..orders {
        let order: Vec<String> = shuffled(names.len(), seed)
            .iter()
            .map(|&i| names[i].clone())
            .collect();
        let given = given.clone().ordered(&order).unwrap();
        let findings = relation_by_relation(&given, &Budget::new(Limits::seconds(100.0))).unwrap();
        let mut before = given.always.clone();
        for (finding, relation) in findings.iter().zip(&given.relations) {
            // Ideals of open chains can take hours: a limit that is the same on every machine.
            let budget = Budget::new(Limits {
                work: Some(3_000_000),
                ..Limits::default()
            });
            if let Ok(verdict) = independent(&before, &relation.equations, given.variables, &budget)
            {
                assert_eq!(
                    finding.verdict, verdict,
                    "{file}, {order:?}: {}",
                    relation.name
                );
                all += 1;
                refused += usize::from(verdict != RelationVerdict::Accepted);
            }
            if finding.verdict == RelationVerdict::Accepted {
                before.extend(relation.equations.iter().cloned());
            }
        }
    }
    (all, refused)
}

const FILES: [&str; 10] = [
    "tests/thesis/plug_lines_and_points.urdf",
    "tests/thesis/block_and_corner.urdf",
    "tests/thesis/double_peg.urdf",
    "tests/thesis/three_bodies.urdf",
    "tests/thesis/thomas_torras_offset.urdf",
    "mechanisms/block_and_corner.urdf",
    "mechanisms/thomas_torras_assembly.urdf",
    "mechanisms/griffis_duffy.urdf",
    "mechanisms/parallelogram.urdf",
    "mechanisms/sarrus.urdf",
];

#[test]
fn relations_in_any_order_are_judged_as_ideals_say() {
    let mut seed = 7;
    let found = FILES
        .iter()
        .take(5)
        .map(|file| compared(file, 2, &mut seed));
    let (all, refused) = found.fold((0, 0), |a, b| (a.0 + b.0, a.1 + b.1));
    assert!(all > 20 && refused > 2, "{all} {refused}");
}

/// What the drawn pose says without a basis is what the bases say; of relations that repeat others it says nothing.
#[test]
fn relations_accepted_at_the_drawn_pose_are_accepted() {
    let options = SystemOptions {
        formulation: Formulation::Positional,
        ..SystemOptions::default()
    };
    let (mut known, mut silent) = (0, 0);
    for file in FILES {
        let mechanism = mechanism(file);
        let (system, given) = relations_of(&mechanism, &options).unwrap();
        let findings = relation_by_relation(&given, &Budget::new(Limits::seconds(100.0))).unwrap();
        for from in 0..findings.len() {
            let before = &findings[..from];
            let accepted = accepted_at_home(&mechanism, (&system, &given), before);
            for (accepted, finding) in accepted.iter().zip(&findings[from..]) {
                let right = !accepted || finding.verdict == RelationVerdict::Accepted;
                assert!(right, "{file}: {}", finding.name);
                known += usize::from(*accepted);
                silent += usize::from(finding.verdict != RelationVerdict::Accepted);
            }
        }
    }
    assert!(known > 50 && silent > 5, "{known} {silent}");
}

/// Too long for every commit.
mod corpus {
    use super::*;

    /// Relations one by one cost what the basis of all of them costs: the median of the ratios of their work, in positional form, where
    /// either comes to its end.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn relations_cost_what_the_basis_costs() {
        let mut ratios: Vec<(f64, f64)> = Vec::new();
        for folder_name in ["mechanisms", "tests/thesis"] {
            let mut files: Vec<_> = std::fs::read_dir(folder(folder_name))
                .unwrap()
                .map(|file| file.unwrap().path())
                .collect();
            files.sort();
            for file in files
                .iter()
                .filter(|file| file.extension().is_some_and(|own| own == "urdf"))
            {
                let options = SystemOptions {
                    formulation: Formulation::Positional,
                    ..SystemOptions::default()
                };
                let Ok(read) = read_file(file, &[]) else {
                    continue;
                };
                let Ok((system, given)) = relations_of(&read.mechanism, &options) else {
                    continue;
                };
                let limits = || Limits {
                    work: Some(5_000_000),
                    ..Limits::seconds(2.0)
                };
                let began = std::time::Instant::now();
                let whole = Budget::new(limits());
                let basis = groebner_basis(
                    &system.polynomials(),
                    system.variables.len(),
                    &MonomialOrder::Degrevlex,
                    &whole,
                );
                let middle = std::time::Instant::now();
                let single = Budget::new(limits());
                let found = relation_by_relation(&given, &single);
                let end = std::time::Instant::now();
                if basis.is_ok() && found.is_ok() {
                    let seconds = (end - middle).as_secs_f64() / (middle - began).as_secs_f64();
                    ratios.push((single.work() as f64 / whole.work().max(1) as f64, seconds));
                }
            }
        }
        let median = |mut all: Vec<f64>| {
            all.sort_by(f64::total_cmp);
            all[all.len() / 2]
        };
        let work = median(ratios.iter().map(|ratio| ratio.0).collect());
        let time = median(ratios.iter().map(|ratio| ratio.1).collect());
        println!(
            "{} files: median ratio of work {work:.2}, of time {time:.2}",
            ratios.len()
        );
        assert!(ratios.len() > 60 && work <= 3.0);
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn relations_in_two_hundred_orders() {
        let mut seed = 11;
        let found = FILES.iter().map(|file| {
            let (all, refused) = compared(file, 20, &mut seed);
            println!("{file}: {all} compared, {refused} not accepted");
            (all, refused)
        });
        let (all, refused) = found.fold((0, 0), |a, b| (a.0 + b.0, a.1 + b.1));
        println!("{all} verdicts compared, {refused} of them not accepted");
        assert!(all > 500 && refused > 50, "{all} {refused}");
    }
}

/// What takes no basis is told where time did not suffice for one: three legs of three hinges leave the platform three freedoms, by
/// the equations of the tree and by their rank.
#[test]
fn the_dimension_at_the_pose_needs_no_basis() {
    for (file, expected) in [
        ("mechanisms/planar_3rrr.urdf", (3, 3)),
        ("mechanisms/planar_four_bar.urdf", (1, 1)),
        // Bennett's motion is not due to the numbers of equations.
        ("mechanisms/bennett.urdf", (0, 1)),
    ] {
        let nothing = Budget::new(Limits {
            work: Some(1),
            ..Limits::default()
        });
        let answer = exact_answer(&mechanism(file), &ExactOptions::default(), &nothing).unwrap();
        assert_eq!(
            answer.stopped.map(|(_, stop)| stop),
            Some(Stop::Work),
            "{file}"
        );
        assert_eq!(answer.at_home_within, Some(expected), "{file}");
    }
}

#[test]
fn graph_shows_the_low_depth_tree() {
    let program = |arguments: &[&str]| {
        let output = crate::support::program()
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .args(arguments)
            .output()
            .unwrap();
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    // Six joints on four links in a complete graph: every cycle of three.
    let text = program(&[
        "graph",
        "tests/thesis/thomas_torras_offset.urdf",
        "--low-depth",
    ]);
    assert!(text.contains("low-depth spanning tree, height 1: cycles of at most 3 joints, found in at most V E² + E V² = 240 steps"), "{text}");
    let data = program(&[
        "graph",
        "mechanisms/cartesian_table.urdf",
        "--low-depth",
        "--format",
        "json",
    ]);
    let data: serde_json::Value = serde_json::from_str(&data).unwrap();
    assert_eq!(
        data["low_depth"]["longest_cycle"],
        2 * data["tree_height"].as_u64().unwrap() + 1
    );
    // The source's choice, by hand, of the joint with two freedoms: every cycle of the block goes through C2.
    let block = program(&[
        "graph",
        "tests/thesis/block_and_corner.urdf",
        "--low-depth",
        "--format",
        "json",
    ]);
    let block: serde_json::Value = serde_json::from_str(&block).unwrap();
    let cycles = block["fundamental_cycles"]["cycles"].as_array().unwrap();
    assert!(
        !cycles.is_empty()
            && cycles
                .iter()
                .all(|cycle| cycle["joints"].to_string().contains("C2")),
        "{block}"
    );
}
