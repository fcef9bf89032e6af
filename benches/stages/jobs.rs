//! Stages as jobs that can be run again and again: what each needs is made ready once, and is not part of it.
//!
//! Shared by `--bench stages`, which times some of them, and `--bench instructions`, which runs one so often.

use super::cases::{Standing, family, mechanism, text};
use kutzbach::algebra::{Budget, ExactOptions, SystemOptions, exact_answer, polynomial_system};
use kutzbach::format::{ReadOptions, read_bytes_of};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{
    AnalysisOptions, ChartOutcome, ChartTest, Depth, Germ, GermZeroOptions, Kernel, MoreDigits,
    PartRank, Pose, Structure, Trial, analyse, chart_test, germ_zeros, rank_part,
};
use kutzbach::motion::{TraceOptions, trace};
use kutzbach::report::text::{Layout, render};
use kutzbach::report::{Input, Options, analysed_report_on};
use kutzbach::simulate::{Drive, World, WorldOptions};
use kutzbach::sweep::{Family, MeasuredFile, Outcome, Over, Plan, Sample, Status, outcome};
use std::hint::black_box;

/// Something to be run; what it found, in a number, so that a test can tell that it found something.
pub type Job = Box<dyn FnMut() -> usize>;

/// At most so many vectors of a kernel, as in the analysis.
const KERNEL_VECTORS: usize = 64;

/// Degree of the series: twice the order of the germs here, as in the analysis.
const DEGREE: usize = 4;

/// Poses of a trace.
const POSES: usize = 100;

/// Members of a family, at random points of its ranges, always the same.
const MEMBERS: u64 = 1000;

/// Steps of a simulation.
const STEPS: usize = 100;

/// One-loop mechanisms at regular poses. The first is decided in double precision; the second needs 106 bits.
pub const CHARTS: [&str; 2] = ["bennett", "goldberg"];

/// Singular poses: two branches that cross, a cusp, four branches of a folded sheet.
pub const GERMS: [&str; 3] = ["flat kite", "cusp", "flat miura"];

/// Mechanisms with exact equations: one loop, two loops, a chain of pegs and holes.
pub const EXACTS: [&str; 3] = ["bennett", "oldham", "double peg"];

/// Mechanisms that are simulated.
pub const SIMULATIONS: [&str; 3] = ["four bar", "bennett", "scissor 100"];

/// A part of a mechanism at its pose, with its rank.
struct Ranked {
    standing: Standing,
    rank: PartRank,
}

impl Ranked {
    fn new(case: &str) -> Self {
        let standing = Standing::new(case);
        let rank = rank_part(&pose(&standing), &standing.structure.parts[0])
            .expect("coordinates are in range");
        Self { standing, rank }
    }

    fn chart(&self) -> ChartTest {
        let pose = pose(&self.standing);
        let kernel = Kernel::of(&pose, &self.rank, KERNEL_VECTORS)
            .expect("coordinates are in range")
            .expect("the rank is decided");
        let part = &self.standing.structure.parts[0];
        // Digits are computed anew each time: keeping them would make all runs but the first cheap.
        chart_test(&pose, &mut MoreDigits::new(), part, &self.rank, &kernel)
            .expect("coordinates are in range")
    }

    fn germ(&self) -> Germ {
        Germ::of_part(&self.standing.mechanism, &self.rank, DEGREE)
            .expect("coordinates are in range")
            .expect("the part is small")
    }
}

fn pose(standing: &Standing) -> Pose<'_> {
    Pose {
        mechanism: &standing.mechanism,
        configuration: None,
        held: &standing.held,
        geometry: &standing.geometry,
        states: &standing.assembly.states,
        as_drawn: standing.assembly.steps == 0,
        trial: Trial::default(),
    }
}

/// Text to mechanism.
pub fn parse(case: &str) -> Job {
    let (text, case) = (text(case), case.to_owned());
    Box::new(move || {
        let read = kutzbach::format::read(black_box(&text), &case, &[]);
        let reading = black_box(read.expect("the file is part of the repository"));
        reading.mechanism.joints().len()
    })
}

/// Blocks, spanning tree, cycles.
pub fn graph(case: &str) -> Job {
    let mechanism = mechanism(case);
    Box::new(move || black_box(Structure::new(black_box(&mechanism))).parts.len())
}

/// Closing the cycles from the file's pose.
pub fn assemble(case: &str) -> Job {
    let standing = Standing::new(case);
    Box::new(move || {
        let assembly = kutzbach::closure::assemble(
            black_box(&standing.mechanism),
            &standing.geometry,
            &standing.structure.parts,
            &standing.held,
        );
        usize::from(assembly.expect("coordinates are in range").closed)
    })
}

/// Jacobian and rank of all parts.
pub fn rank(case: &str) -> Job {
    let standing = Standing::new(case);
    Box::new(move || {
        let ranked = |part| rank_part(black_box(&pose(&standing)), part);
        let ranks = standing.structure.parts.iter().map(ranked);
        let freedoms = ranks.map(|r| r.expect("coordinates are in range").instantaneous);
        freedoms.map(|f| f.unwrap_or(0)).sum()
    })
}

/// Whether the pose is regular, its rank being known.
pub fn chart(case: &str) -> Job {
    let ranked = Ranked::new(case);
    Box::new(move || usize::from(black_box(&ranked).chart().outcome == ChartOutcome::Regular))
}

/// Bits of the arithmetic that decides whether the pose is regular.
pub fn chart_bits(case: &str) -> u32 {
    Ranked::new(case).chart().bits
}

/// The power series at a singular pose, its rank being known.
pub fn germ_series(case: &str) -> Job {
    let ranked = Ranked::new(case);
    Box::new(move || black_box(&ranked).germ().order().unwrap_or(0))
}

/// The real zeros of the power series.
pub fn germ_branches(case: &str) -> Job {
    let germ = Ranked::new(case).germ();
    let order = germ.order().expect("the pose is singular");
    Box::new(move || {
        let options = GermZeroOptions::default();
        let zeros = germ_zeros(
            germ.freedom(),
            black_box(germ.equations()),
            germ.noise(order),
            &options,
        );
        zeros.branches.len()
    })
}

/// The equations as polynomials.
pub fn exact_equations(case: &str) -> Job {
    let mechanism = mechanism(case);
    Box::new(move || {
        let system = polynomial_system(black_box(&mechanism), &SystemOptions::default());
        system.expect("the numbers are exact").equations.len()
    })
}

/// From the mechanism to everything that its polynomials say.
pub fn exact_answers(case: &str) -> Job {
    let mechanism = mechanism(case);
    Box::new(move || {
        let answer = exact_answer(
            black_box(&mechanism),
            &ExactOptions::default(),
            &Budget::unlimited(),
        );
        let answer = answer.expect("the numbers are exact");
        assert!(answer.stopped.is_none());
        answer.dimension.flatten().unwrap_or(0)
    })
}

/// The whole analysis.
pub fn whole_analysis(case: &str) -> Job {
    let mechanism = mechanism(case);
    Box::new(move || {
        let analysis = analyse(black_box(&mechanism), &AnalysisOptions::default());
        let mobility = analysis.expect("coordinates are in range").mobility;
        mobility.bounds.0.unwrap_or(0)
    })
}

/// A hundred poses of the predicted motion, from the analysis on.
pub fn traced(case: &str) -> Job {
    let mechanism = mechanism(case);
    let analysis =
        analyse(&mechanism, &AnalysisOptions::default()).expect("coordinates are in range");
    Box::new(move || {
        let options = TraceOptions {
            samples: POSES,
            ..TraceOptions::default()
        };
        let traced = trace(black_box(&mechanism), &analysis, &options);
        let traced = traced.expect("nothing is asked for that is not there");
        black_box(traced)
            .motion()
            .map_or(0, |motion| motion.samples.len())
    })
}

/// A world at the file's pose, its first joint driven.
fn world(mechanism: &Mechanism, standing: &Standing) -> World {
    let states = &standing.assembly.states;
    let mut world = World::new(
        mechanism,
        &standing.geometry,
        states,
        &WorldOptions::default(),
    )
    .expect("coordinates are in range");
    let joint = mechanism
        .joints()
        .iter()
        .position(|joint| joint.freedom() == 1)
        .expect("there is a joint with a freedom");
    world
        .drive(Drive {
            joint,
            freedom: 0,
            velocity: 0.1,
            largest_force: f64::INFINITY,
        })
        .expect("the joint exists");
    world
}

/// Building a world.
pub fn built_world(case: &str) -> Job {
    let standing = Standing::new(case);
    Box::new(move || {
        world(black_box(&standing.mechanism), &standing)
            .pieces()
            .bodies
    })
}

/// A hundred steps of a new world.
pub fn simulated(case: &str) -> Job {
    let standing = Standing::new(case);
    Box::new(move || {
        let mut world = world(black_box(&standing.mechanism), &standing);
        for _ in 0..STEPS {
            world.step().expect("it stays in one piece");
        }
        black_box(world.link_poses()).len()
    })
}

/// One step of a world that goes on.
pub fn stepped(case: &str) -> Job {
    let standing = Standing::new(case);
    let mut world = world(&standing.mechanism, &standing);
    Box::new(move || {
        world.step().expect("it stays in one piece");
        1
    })
}

/// A report as a page of text, the analysis being known.
pub fn written_report(case: &str) -> Job {
    let mechanism = mechanism(case);
    let input = Input {
        mechanism: &mechanism,
        file: case,
        format: "urdf",
        warnings: &[],
        skipped: &[],
    };
    let (report, _) =
        analysed_report_on(&input, &Options::default()).expect("the home pose exists");
    Box::new(move || render(black_box(&report), Layout::default()).len())
}

/// A row of a sweep, whose file is parsed and whose structure is known; every run is of the next member.
pub fn row(case: &str, depth: Depth) -> Job {
    // Members borrow their family, and a job is its own.
    let family: &'static Family = Box::leak(Box::new(swept(case, depth)));
    let members = family.members();
    members.row(0).expect("there are members");
    let mut numbers = (0..MEMBERS).cycle();
    Box::new(move || {
        let row = numbers.next().and_then(|number| members.row(number));
        is_analysed(&black_box(row.expect("there are members")).outcome)
    })
}

/// The same of a file by itself, made anew; every run is of the next member.
pub fn file(case: &str, depth: Depth) -> Job {
    let family = swept(case, depth);
    let mut numbers = (0..MEMBERS).cycle();
    Box::new(move || {
        let number = numbers.next().expect("they begin again");
        is_analysed(&black_box(of_own_file(&family, number)))
    })
}

fn is_analysed(found: &Outcome) -> usize {
    usize::from(found.status == Status::Analysed)
}

fn swept(case: &str, depth: Depth) -> Family {
    let (text, over) = family(case).expect("it is a family");
    let over: Result<Vec<Over>, _> = over.iter().map(|own| Over::read(own)).collect();
    let over = over.expect("the ranges are written right");
    let plan = Plan::new(over, Some(Sample::Random(MEMBERS))).expect("each measure is there once");
    Family::new(MeasuredFile::of_text(text, case), plan, asked(depth))
        .expect("the file is part of the repository")
}

fn asked(depth: Depth) -> AnalysisOptions {
    AnalysisOptions {
        depth,
        ..AnalysisOptions::default()
    }
}

fn of_own_file(family: &Family, number: u64) -> Outcome {
    let source = family.source();
    let mut text = String::from_utf8_lossy(&source.bytes).into_owned();
    let values = family.plan().values(number).expect("there are members");
    for (name, value) in family.plan().names().zip(&values) {
        text = with_value(&text, name, &value.setting);
    }
    let read = read_bytes_of(text.as_bytes(), &source.file, None, &ReadOptions::default());
    let mechanism = read.expect("every member is a mechanism").mechanism;
    let analysis = analyse(&mechanism, &asked(family.depth())).expect("coordinates are in range");
    outcome(&mechanism, &analysis, family.depth())
}

/// The file with another value where it names a measure.
fn with_value(text: &str, name: &str, value: &str) -> String {
    let heads = ["default", "value"].map(|own| format!("name=\"{name}\" {own}=\""));
    let ends = heads
        .iter()
        .find_map(|head| Some(text.find(head)? + head.len()));
    let (before, after) = text.split_at(ends.expect("the file names it"));
    let (_, after) = after.split_once('"').expect("the value ends");
    format!("{before}{value}\"{after}")
}
