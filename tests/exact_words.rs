//! What `kutzbach exact` says of cycles in the words of mechanisms: what is left of a joint, which links are one body, at
//! which values joints are fixed.

use kutzbach::algebra::{
    Budget, CycleAnswer, ExactAnswer, ExactOptions, Formulation, Limits, ProvenMotion, Scope,
    Settled, Stop, SystemOptions, exact_answer,
};
use kutzbach::format::{read, read_file};
use kutzbach::group::{DisplacementSubgroup, SubgroupKind};
use kutzbach::mechanism::{LinkId, Mechanism};
use kutzbach::report::exact::{ExactReport, Request, exact_report, render};
use kutzbach::report::text::Layout;
use std::path::Path;

fn mechanism(file: &str, settings: &[(&str, &str)]) -> Mechanism {
    let settings: Vec<(String, String)> = settings
        .iter()
        .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()))
        .collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    read_file(&path, &settings).unwrap().mechanism
}

fn answer_of(mechanism: &Mechanism, formulation: Formulation) -> ExactAnswer {
    let options = ExactOptions {
        system: SystemOptions {
            formulation,
            ..SystemOptions::default()
        },
        ..ExactOptions::default()
    };
    // Generous: a slow machine must not fail a test of mathematics.
    let budget = Budget::new(Limits::seconds(300.0));
    let answer = exact_answer(mechanism, &options, &budget).unwrap();
    assert_eq!(answer.stopped, None);
    answer
}

struct Asked {
    mechanism: Mechanism,
    answer: ExactAnswer,
}

fn asked(file: &str) -> Asked {
    asked_with(file, &[], Formulation::Canonical)
}

fn asked_with(file: &str, settings: &[(&str, &str)], formulation: Formulation) -> Asked {
    let mechanism = mechanism(&format!("mechanisms/{file}.urdf"), settings);
    let answer = answer_of(&mechanism, formulation);
    Asked { mechanism, answer }
}

impl Asked {
    fn names(&self, links: &[LinkId]) -> Vec<&str> {
        let name = |link: &LinkId| self.mechanism.link(*link).name.as_str();
        links.iter().map(name).collect()
    }

    /// A statement in short: link, what it is seen from, class, where it holds.
    fn short<'a>(&'a self, motion: &'a ProvenMotion) -> (&'a str, &'a str, &'static str, Scope) {
        let name = |link: LinkId| self.mechanism.link(link).name.as_str();
        (
            name(motion.link),
            name(motion.relative_to),
            motion.subgroup.short_name(),
            motion.scope,
        )
    }

    fn cycle(&self, name: &str) -> &CycleAnswer {
        let mut cycles = self.answer.cycles.iter();
        cycles.find(|cycle| cycle.name == name).unwrap()
    }

    fn of_cycle(&self, name: &str) -> Vec<(&str, &str, &'static str, Scope)> {
        let motions = self.cycle(name).motions.iter();
        motions.map(|motion| self.short(motion)).collect()
    }

    /// The cycle where there is but one.
    fn only(&self) -> Vec<(&str, &str, &'static str, Scope)> {
        assert_eq!(self.answer.cycles.len(), 1);
        self.of_cycle(&self.answer.cycles[0].name)
    }

    fn clusters(&self) -> Vec<Vec<&str>> {
        let clusters = self.answer.clusters.iter();
        clusters.map(|links| self.names(links)).collect()
    }

    fn report(&self) -> ExactReport {
        let request = Request {
            file: "file.urdf".to_owned(),
            ..Request::default()
        };
        exact_report(&self.mechanism, &self.answer, &request)
    }
}

use Scope::{Everywhere, PiecesOfHome};

#[test]
fn two_pegs_leave_the_push() {
    let pegs = asked("double_peg_and_hole");
    assert_eq!(pegs.only(), [("plug", "socket", "T", Everywhere)]);
    assert_eq!(pegs.answer.cycles[0].settled, Settled::Yes);
    assert!(pegs.clusters().is_empty(), "the plug can still be pulled");
    let report = pegs.report();
    let [motion] = report.cycles[0].motions.as_slice() else {
        panic!("{:?}", report.cycles[0].motions);
    };
    assert_eq!(
        motion.text,
        "reduces to translation along (0, 0, 1) (plug relative to socket)"
    );
    assert_eq!(motion.joints, ["left_peg", "right_peg"]);
    assert_eq!((motion.class, motion.freedom), ("T", 1));
    let fixed: Vec<&str> = report
        .fixed_joints
        .iter()
        .map(|j| j.text.as_str())
        .collect();
    assert_eq!(
        fixed,
        [
            "joint left_peg: rotation fixed at 0\u{b0}",
            "joint right_peg: rotation fixed at 0\u{b0}"
        ]
    );
}

#[test]
fn a_pin_holds_the_drawer() {
    let bodies = asked("three_body_assembly");
    assert_eq!(bodies.clusters(), [["case", "drawer"]]);
    // The pin turns and slides in its holes as one hole would let it.
    assert_eq!(bodies.only(), []);
    let [rail] = &bodies.report().fixed_joints[..] else {
        panic!("more than the rail is fixed");
    };
    assert_eq!(rail.joint.as_deref(), Some("rail"));
    assert_eq!(
        rail.text,
        "joint rail: slide fixed at 0 m, rotation fixed at 0\u{b0}"
    );
    assert_eq!(rail.freedoms[0].unit, " m");
    assert_eq!(rail.freedoms[1].drawn, Some(0.0));
}

#[test]
fn jaws_become_one_body_only_together() {
    let jaws = asked("thomas_torras_assembly");
    assert_eq!(
        jaws.of_cycle("frame_jaw_1 \u{2013} jaw_1_jaw_2 \u{2013} frame_jaw_2"),
        [("jaw_2", "jaw_1", "T", Everywhere)]
    );
    let text = &jaws.report().cycles[0].motions[0].text;
    assert_eq!(
        text,
        "the cylindrical joint jaw_1_jaw_2 is left with translation along (1, 0, 0), its axis"
    );
    // Each cycle with the pin holds one jaw; the whole holds both.
    assert_eq!(jaws.clusters(), [["frame", "jaw_1", "jaw_2"]]);
}

#[test]
fn sarrus_rises_straight() {
    let sarrus = asked("sarrus");
    assert_eq!(sarrus.only(), [("plate", "base", "T", Everywhere)]);
    let motion = &sarrus.answer.cycles[0].motions[0];
    assert!(motion.joints.is_empty());
    assert_eq!(motion.subgroup.to_string(), "translation along (0, 0, 1)");
    assert_eq!(
        sarrus.report().cycles[0].motions[0].text,
        "plate relative to base is left with translation along (0, 0, 1)"
    );
}

#[test]
fn a_parallelogram_translates_until_it_is_flat() {
    let shape = |asked: &Asked| -> Vec<(String, String, &'static str, Scope)> {
        let own = |(a, b, c, d): (&str, &str, _, _)| (a.to_owned(), b.to_owned(), c, d);
        asked.only().into_iter().map(own).collect()
    };
    let drawn = shape(&asked("parallelogram"));
    assert!(
        drawn.contains(&(
            "coupler".to_owned(),
            "ground".to_owned(),
            "T2",
            PiecesOfHome
        )),
        "{drawn:?}"
    );
    // Flat, both ways to go on pass through the drawn pose, and the crossed one turns the coupler.
    assert_eq!(shape(&asked("parallelogram_flat")), []);
}

#[test]
fn the_tree_form_says_the_same() {
    for (file, expected) in [
        ("double_peg_and_hole", ("plug", "socket", "T", Everywhere)),
        ("sarrus", ("plate", "base", "T", Everywhere)),
    ] {
        let tree = asked_with(file, &[], Formulation::Tree);
        assert_eq!(tree.only(), [expected], "{file}");
        // The slide that no equation of the pegs mentions counts all the same.
        let (cycle, whole) = (tree.answer.cycles[0].dimension, tree.answer.dimension);
        assert_eq!(Some(cycle), whole, "{file}");
    }
}

#[test]
fn what_the_joints_allow_is_not_said() {
    for file in ["oldham", "bennett", "planar_four_bar", "spherical_four_bar"] {
        let found = asked(file);
        assert_eq!(found.only(), [], "{file}");
        assert_eq!(found.answer.cycles[0].settled, Settled::Yes, "{file}");
    }
}

#[test]
fn a_ball_among_hinges_turns_about_one_axis() {
    let bennett = asked("bennett_with_ball");
    let motion = &bennett.answer.cycles[0].motions[0];
    assert_eq!(motion.subgroup.kind(), SubgroupKind::Rotation);
    assert_eq!(motion.scope, Everywhere);
}

#[test]
fn directions_may_be_irrational() {
    let written = r#"<robot name="pegs"><link name="socket"/><link name="plug"/>
        <joint name="left" type="cylindrical"><parent link="socket"/><child link="plug"/>
          <origin xyz="0 0 0" rpy="0 ${pi/6} 0"/><axis xyz="0 0 1"/></joint>
        <loop name="right" type="cylindrical">
          <predecessor link="socket"><origin xyz="0 0.02 0" rpy="0 ${pi/6} 0"/></predecessor>
          <successor link="plug"><origin xyz="0 0.02 0"/></successor>
          <axis xyz="0 0 1"/></loop></robot>"#;
    let mechanism = read(written, "pegs.urdf", &[]).unwrap().mechanism;
    let answer = answer_of(&mechanism, Formulation::Canonical);
    let [motion] = answer.cycles[0].motions.as_slice() else {
        panic!("{:?}", answer.cycles[0].motions);
    };
    let DisplacementSubgroup::Translation { direction } = motion.subgroup else {
        panic!("{}", motion.subgroup);
    };
    let expected = [0.5, 0.0, 0.75_f64.sqrt()];
    for (found, expected) in direction.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-15, "{direction}");
    }
}

#[test]
fn bodies_fixed_in_the_positional_form_are_one_with_the_ground() {
    let plug = answer_of(
        &mechanism("tests/thesis/plug_lines_and_point.urdf", &[]),
        Formulation::Positional,
    );
    assert_eq!(plug.clusters, [[LinkId(0), LinkId(1)]]);
    let sliding = answer_of(
        &mechanism("tests/thesis/plug_two_lines.urdf", &[]),
        Formulation::Positional,
    );
    assert!(sliding.clusters.is_empty());
}

#[test]
fn a_prime_tells_the_dimension_where_the_rationals_are_out_of_reach() {
    let mechanism = mechanism("mechanisms/sarrus.urdf", &[]);
    let options = ExactOptions::default();
    let enough = exact_answer(&mechanism, &options, &Budget::unlimited()).unwrap();
    assert_eq!(enough.dimension_modulo, None, "the rationals know better");
    let work = enough.steps[0].work;
    let limited = |work| {
        let limits = Limits {
            work: Some(work),
            ..Limits::default()
        };
        exact_answer(&mechanism, &options, &Budget::new(limits)).unwrap()
    };
    // Two primes are needed, and more than half of the work is for the first and the check together.
    let answer = limited(work * 2 / 3);
    assert_eq!(answer.stopped, Some(("the basis", Stop::Work)));
    assert_eq!(answer.dimension, None);
    let (prime, dimension) = answer.dimension_modulo.unwrap();
    assert_eq!(dimension, enough.dimension.unwrap());
    let report = exact_report(&mechanism, &answer, &Request::default());
    let text = render(&report, Layout::default());
    let said = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let expected = format!(
        "modulo the prime {prime} the dimension is 2; over the rationals not computed: evidence, no proof"
    );
    assert!(said.contains(&expected), "{text}");
    assert!(said.contains("Undecided"), "{text}");
    assert_eq!(limited(1).dimension_modulo, None);
}

#[test]
fn a_page_on_two_pegs() {
    let text = render(&asked("double_peg_and_hole").report(), Layout::default());
    let cycles = text.split("Cycles by themselves").nth(1).unwrap();
    let cycles = cycles.split("Steps").next().unwrap();
    let expected = "
  \u{2022} cycle left_peg \u{2013} right_peg: dimension 1
      - reduces to translation along (0, 0, 1) (plug relative to socket)
      - joint left_peg: rotation fixed at 0\u{b0}
      - joint right_peg: rotation fixed at 0\u{b0}

";
    assert_eq!(cycles, expected);
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn bars_on_faces_reduce_to_planar_motion() {
        let table = asked("cartesian_table");
        assert_eq!(
            table.of_cycle("x_bar_on_bed \u{2013} z_bar_on_bed"),
            [("lower_bars", "bed", "G", PiecesOfHome)]
        );
        assert_eq!(
            table.of_cycle("x_bar_on_top \u{2013} y_bar_on_top"),
            [("top", "upper_bars", "G", PiecesOfHome)]
        );
        assert_eq!(table.clusters(), [["lower_bars", "cross", "upper_bars"]]);
        // All together leave less than each cycle: no turn.
        let whole: Vec<_> = table
            .answer
            .motions
            .iter()
            .map(|m| table.short(m))
            .collect();
        assert_eq!(
            whole,
            [
                ("top", "bed", "T2", PiecesOfHome),
                ("lower_bars", "bed", "T2", PiecesOfHome),
                ("top", "upper_bars", "T2", PiecesOfHome),
            ]
        );
        let report = table.report();
        let bed = &report.fixed_joints[0];
        assert_eq!(
            bed.text,
            "joint bed_top: rotation fixed at 0\u{b0} in this assembly mode (180\u{b0} in others)"
        );
        let normal = |motion: &ProvenMotion| match motion.subgroup {
            DisplacementSubgroup::PlanarTranslation { normal } => normal.into(),
            other => panic!("{other}"),
        };
        let normals: Vec<[f64; 3]> = table.answer.motions.iter().map(normal).collect();
        assert_eq!(normals, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    }
}
