//! Runs the computations of the tables and of the families.

use super::published::{ALL, Computation, TABLES, TOGETHER, Way};
use super::record::{Cost, Figures, Loop, Row, Scene, Size, Table};
use super::scenes::{FAMILIES, Family};
use kutzbach::algebra::{
    Budget, Component, Formulation, Group, Hints, Limits, MonomialOrder, PolynomialSystem, Problem,
    Step, SystemOptions, brute_force, components, divide_and_conquer, incremental_instancing,
    polynomial_system,
};
use kutzbach::format::{read, read_file};
use kutzbach::mechanism::Mechanism;
use std::error::Error;
use std::time::Instant;

pub type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Seconds that one computation of a table may take.
const TABLE_LIMIT: f64 = 60.0;

/// Loops of hinges, with the formulation in which their equations are shortest.
const LOOPS: [(&str, &str); 4] = [
    ("planar four-bar", "mechanisms/planar_four_bar.urdf"),
    ("Bennett", "mechanisms/bennett.urdf"),
    ("Goldberg's five-bar", "mechanisms/goldberg_five_bar.urdf"),
    ("threefold Bricard", "mechanisms/bricard_threefold.urdf"),
];

/// The equations of a mechanism, grouped by cycle; every group is called by the names of its joints.
fn problem(mechanism: &Mechanism, positional: bool) -> Result<(PolynomialSystem, Problem)> {
    let options = SystemOptions {
        formulation: match positional {
            true => Formulation::Positional,
            false => Formulation::Canonical,
        },
        unoriented: positional,
        ..SystemOptions::default()
    };
    let system = polynomial_system(mechanism, &options)?;
    let groups = system.cycles.iter().map(|cycle| {
        let mut joints: Vec<&str> = cycle
            .joints
            .iter()
            .map(|(joint, _)| mechanism.joint(*joint).name.as_str())
            .collect();
        joints.sort_unstable();
        Group {
            name: joints.join(" – "),
            equations: cycle.equations.clone(),
        }
    });
    let problem = Problem {
        variables: system.variables.len(),
        groups: groups.collect(),
        equations: system
            .equations
            .iter()
            .map(|e| e.polynomial.clone())
            .collect(),
    };
    Ok((system, problem))
}

/// The steps of a way; those of one name together, with how many there are.
fn steps(
    problem: &Problem,
    way: Way,
    order: &MonomialOrder,
    limit: f64,
) -> Option<Vec<(Step, usize)>> {
    let budget = Budget::new(Limits::seconds(limit));
    let steps = match way {
        Way::Brute => vec![brute_force(problem, order, &budget).ok()?.0],
        Way::Divide => divide_and_conquer(problem, order, &budget).ok()?.steps,
        Way::Instancing => incremental_instancing(problem, &budget).ok()?.steps,
    };
    let mut grouped: Vec<(Step, usize)> = Vec::new();
    for step in steps {
        match grouped
            .iter_mut()
            .find(|(first, _)| first.name == step.name)
        {
            None => grouped.push((step, 1)),
            Some((first, count)) => {
                first.time += step.time;
                first.work += step.work;
                *count += 1;
            }
        }
    }
    Some(grouped)
}

/// The row a step belongs to.
fn row_name(step: &Step, way: Way, problem: &Problem) -> String {
    match way {
        Way::Brute => ALL.to_owned(),
        _ if problem.groups.iter().any(|g| g.name == step.name) => step.name.clone(),
        _ => TOGETHER.to_owned(),
    }
}

fn rows(computation: &Computation, rounds: usize) -> Result<Vec<Row>> {
    let mechanism = read_file(computation.file, &[])?.mechanism;
    let (_, problem) = problem(&mechanism, computation.positional)?;
    let way = computation.way;
    let found = steps(&problem, way, &MonomialOrder::Degrevlex, TABLE_LIMIT);
    let lexicographic = match way {
        Way::Instancing => None,
        _ => steps(&problem, way, &MonomialOrder::Lexicographic, TABLE_LIMIT),
    };
    let mut ours: Vec<(String, Figures)> = Vec::new();
    for (place, (step, cases)) in found.iter().flatten().enumerate() {
        let lex = lexicographic.as_ref().and_then(|steps| steps.get(place));
        ours.push((
            row_name(step, way, &problem),
            Figures {
                variables: step.variables,
                equations: step.equations,
                basis: Some(step.basis),
                lexicographic: lex.map(|(step, _)| step.basis),
                seconds: Some(step.time.as_secs_f64()),
                cases: *cases,
            },
        ));
    }
    for _ in 1..rounds {
        let again = steps(&problem, way, &MonomialOrder::Degrevlex, TABLE_LIMIT);
        for ((_, figures), (step, _)) in ours.iter_mut().zip(again.iter().flatten()) {
            let seconds = step.time.as_secs_f64();
            figures.seconds = figures.seconds.map(|best| best.min(seconds));
        }
    }
    let row = |what: &str, published: Option<Figures>, ours: Option<Figures>| Row {
        example: computation.example.to_owned(),
        variables: if computation.positional {
            "positional"
        } else {
            "canonical"
        }
        .to_owned(),
        way: match way {
            Way::Brute => "all at once",
            Way::Divide => "divide and conquer",
            Way::Instancing => "instancing",
        }
        .to_owned(),
        what: what.to_owned(),
        published,
        ours,
    };
    let mut rows = Vec::new();
    for (what, (variables, equations, basis)) in computation.rows {
        let published = Figures {
            variables: *variables,
            equations: *equations,
            basis: basis.map(|b| b.0),
            lexicographic: None,
            seconds: basis.map(|b| b.1),
            cases: 1,
        };
        let place = ours.iter().position(|(name, _)| name == what);
        rows.push(row(what, Some(published), place.map(|p| ours.remove(p).1)));
    }
    // Cycles that the source does not have come before everything together.
    let at = rows.len().saturating_sub(1);
    for (what, figures) in ours.into_iter().rev() {
        rows.insert(at, row(&what, None, Some(figures)));
    }
    Ok(rows)
}

/// The tables of the source beside ours; times are the best of so many rounds.
///
/// # Errors
/// Where a file cannot be read or has no polynomial equations.
pub fn tables(rounds: usize, tell: impl Fn(&str)) -> Result<Vec<Table>> {
    let mut tables = Vec::new();
    for table in TABLES {
        tell(&format!("table {}", table.number));
        let mut all = Vec::new();
        for computation in table.computations {
            all.extend(rows(computation, rounds)?);
        }
        tables.push(Table {
            number: table.number.to_owned(),
            title: table.title.to_owned(),
            rows: all,
        });
    }
    Ok(tables)
}

/// What a way costs, and the dimension and the number of cases it finds.
fn cost(problem: &Problem, way: Way, limit: f64) -> Option<(Cost, Option<usize>, usize)> {
    let budget = Budget::new(Limits::seconds(limit));
    let order = MonomialOrder::Degrevlex;
    let started = Instant::now();
    let (dimension, cases) = match way {
        Way::Brute => (brute_force(problem, &order, &budget).ok()?.1.dimension(), 1),
        Way::Divide => (
            divide_and_conquer(problem, &order, &budget)
                .ok()?
                .basis
                .dimension(),
            1,
        ),
        Way::Instancing => {
            let found = incremental_instancing(problem, &budget).ok()?;
            (found.dimension(), found.combinations())
        }
    };
    let cost = Cost {
        seconds: started.elapsed().as_secs_f64(),
        work: budget.work(),
    };
    Some((cost, dimension, cases))
}

/// One member of a family by all three ways.
///
/// # Errors
/// Where the member has no polynomial equations.
pub fn size(family: &Family, n: usize, limit: f64) -> Result<Size> {
    let mechanism = read(&(family.text)(n), family.name, &[])?.mechanism;
    let (_, problem) = problem(&mechanism, false)?;
    let found = [Way::Brute, Way::Divide, Way::Instancing].map(|way| cost(&problem, way, limit));
    let dimensions: Vec<Option<usize>> = found.iter().flatten().map(|(_, d, _)| *d).collect();
    if dimensions.windows(2).any(|pair| pair[0] != pair[1]) {
        return Err(format!("{} of {n}: the ways disagree: {dimensions:?}", family.name).into());
    }
    Ok(Size {
        n,
        variables: problem.variables,
        equations: problem.equations.len(),
        dimension: dimensions.first().copied().flatten(),
        cases: found[2].as_ref().map(|(_, _, cases)| *cases),
        ways: found.map(|way| way.map(|(cost, _, _)| cost)),
    })
}

/// All families, each way of each member within so many seconds.
///
/// # Errors
/// As [`size`].
pub fn scenes(limit: f64, tell: impl Fn(&str)) -> Result<Vec<Scene>> {
    let mut scenes = Vec::new();
    for family in FAMILIES {
        let mut sizes = Vec::new();
        for &n in family.sizes {
            tell(&format!("{}: {n}", family.name));
            sizes.push(size(family, n, limit)?);
        }
        scenes.push(Scene {
            name: family.name.to_owned(),
            about: family.about.to_owned(),
            sizes,
        });
    }
    Ok(scenes)
}

/// Loops of hinges: the basis from our own files, and the piece of the largest dimension.
///
/// # Errors
/// Where a file cannot be read or has no polynomial equations, or a limit is reached.
pub fn loops(rounds: usize) -> Result<Vec<Loop>> {
    let mut loops = Vec::new();
    for (name, file) in LOOPS {
        let mechanism = read_file(file, &[])?.mechanism;
        let (system, problem) = problem(&mechanism, false)?;
        let budget = Budget::new(Limits::seconds(TABLE_LIMIT));
        let mut seconds = f64::INFINITY;
        let mut last = None;
        for _ in 0..rounds {
            let started = Instant::now();
            last = Some(brute_force(&problem, &MonomialOrder::Degrevlex, &budget)?.1);
            seconds = seconds.min(started.elapsed().as_secs_f64());
        }
        let basis = last.ok_or("no round was asked for")?;
        let pieces = components(
            basis.polynomials(),
            system.variables.len(),
            &Hints::default(),
            &budget,
        )?;
        let largest = pieces
            .pieces
            .iter()
            .max_by_key(|piece: &&Component| piece.dimension);
        loops.push(Loop {
            name: name.to_owned(),
            dimension: basis.dimension(),
            degree: largest.and_then(|piece| piece.degree).map(|d| d as u64),
            basis: basis.polynomials().len(),
            seconds,
        });
    }
    Ok(loops)
}
