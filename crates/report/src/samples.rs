//! Reports made by hand, for tests of what is shown and compared.

use super::schema::*;
use kutzbach_mobility::{CertificateLevel, MobilityClass, PoseKind, SingularKind, Verdict};

/// A joint of one freedom between two links.
pub(crate) fn revolute(name: &str, links: [&str; 2], closes_loop: bool) -> JointRow {
    JointRow {
        name: name.to_owned(),
        class: "R".to_owned(),
        kind: "revolute".to_owned(),
        links: links.map(str::to_owned),
        freedom: 1,
        locked: Some(false),
        locked_parts: Vec::new(),
        redundant_wrenches: Some(0),
        redundant_directions: Vec::new(),
        closes_loop,
        block: None,
        ranges: Vec::new(),
    }
}

/// A joint of another kind.
pub(crate) fn joint(name: &str, class: &str, kind: &str, freedom: usize) -> JointRow {
    JointRow {
        class: class.to_owned(),
        kind: kind.to_owned(),
        freedom,
        ..revolute(name, ["a", "b"], false)
    }
}

/// Bennett's loop: four hinges, Kutzbach −2, and yet one freedom.
pub(crate) fn mobile() -> Report {
    let mut joints = vec![
        revolute("J1", ["B0", "B1"], false),
        revolute("J2", ["B1", "B2"], false),
        revolute("J3", ["B2", "B3"], true),
        revolute("J4", ["B0", "B3"], false),
    ];
    for joint in &mut joints {
        joint.redundant_wrenches = Some(3);
    }
    Report {
        schema: SCHEMA.to_owned(),
        mechanism: "bennett".to_owned(),
        source: Source {
            file: "mechanisms/bennett.urdf".to_owned(),
            format: "urdf".to_owned(),
            digits: Some(12),
            exact: false,
            precision: None,
            constants: None,
            written: vec![crate::schema::WrittenKind {
                kind: "lengths".to_owned(),
                style: crate::schema::WrittenStyle::Decimals,
                decimals: Some(12),
                significant: None,
            }],
            rounded_by: None,
            residues: Vec::new(),
        },
        size: Size {
            links: 4,
            joints: 4,
            loops: 1,
            couplings: 0,
            freedoms: 4,
        },
        kutzbach: -2,
        generic: Some(GenericCount {
            mobility: 0,
            redundant: 2,
        }),
        assembly: Assembly {
            closed: Some(true),
            residual: Some(3.1e-13),
            moved: Some(0.0),
            tolerance: Some(1e-11),
            starts: Some(1),
            ..Assembly::default()
        },
        home: Home {
            configuration: "home".to_owned(),
            pose: Some(PoseKind::Regular),
            kind: None,
            instantaneous: Some(1),
            candidates: [1, 1],
            as_written: Some(0),
            redundant: Some(3),
            rank: Some(3),
            equations: 6,
            unknowns: 4,
            gap: Some(8.4e11),
            kept: Some(0.213),
            dropped: Some(2.54e-13),
            tolerance: Some(6e-12),
            accuracy: Some(1e-12),
            method: "singular values".to_owned(),
            bits: Some(53),
            blocks: vec![Block {
                name: "J1".to_owned(),
                label: "J1".to_owned(),
                joints: 4,
                unknowns: 4,
                rank: Some(3),
                instantaneous: Some(1),
                finite: Some(1),
                pose: Some(PoseKind::Regular),
                kind: None,
                class: Some(MobilityClass::Paradoxical),
            }],
            weakest: None,
            note: None,
        },
        mobility: Mobility {
            verdict: Verdict::Mobile,
            finite: Some(1),
            bounds: [Some(1), Some(1)],
            complex_dimension: Some(1),
            class: Some(MobilityClass::Paradoxical),
            certificate: Some(Certificate {
                level: CertificateLevel::Numeric,
                text: "the loop stays closed within 4e-13 m over a full turn of J1".to_owned(),
            }),
            nominal: None,
            as_written: None,
            why: vec![
                "opposite sides are equal and lengths are as the sines of the twists".to_owned(),
            ],
        },
        freedoms: None,
        inputs: None,
        branches: Some(vec![Branch {
            name: "A".to_owned(),
            dimension: 1,
            instantaneous: Some(1),
            redundant: Some(3),
            half_branches: Some(2),
            locked: Vec::new(),
            nearly_idle: Vec::new(),
            idle: Vec::new(),
        }]),
        joints,
        couplings: Vec::new(),
        cycles: vec![Cycle {
            name: "J3".to_owned(),
            joints: ["J1", "J2", "J3", "J4"].map(str::to_owned).to_vec(),
            space: None,
            space_text: "all displacements".to_owned(),
            dimension: Some(6),
            rank: Some(3),
            redundant: Some(3),
            mobility: Some(1),
            locks: Vec::new(),
        }],
        tree: Some(Tree {
            root: "B0".to_owned(),
            depth: 2,
            links: vec![TreeLink {
                link: "B1".to_owned(),
                parent: "B0".to_owned(),
                joint: "J1".to_owned(),
                depth: 1,
            }],
        }),
        motions: vec![Motion {
            link: "B1".to_owned(),
            relative_to: "B0".to_owned(),
            freedom: Some(1),
            class: "R".to_owned(),
            text: "rotation about the axis of J1".to_owned(),
            rotations: Some(1),
            within: None,
            joint: None,
            pitches: None,
            tilts: None,
            whole_branch: false,
            translations: Some(0),
            branch: "A".to_owned(),
            asked: false,
        }],
        advice: vec![Advice {
            text: "Let J3 also slide along its axis (R → C).".to_owned(),
            joint: "J3".to_owned(),
            from: "R".to_owned(),
            to: "C".to_owned(),
            redundant_before: 3,
            redundant_after: 2,
        }],
        change_sets: None,
        play: None,
        four_bars: Vec::new(),
        warnings: Vec::new(),
        skipped: vec!["line 3, column 5: <gazebo>".to_owned()],
        evidence: None,
        timing: None,
        depth: None,
    }
}

/// Three parallel hinges in a triangle, stretched flat: it gives way and goes nowhere.
pub(crate) fn rigid() -> Report {
    let mut report = mobile();
    report.mechanism = "collinear_3r".to_owned();
    report.source = Source {
        file: "collinear_3r.urdf".to_owned(),
        format: "urdf".to_owned(),
        digits: Some(1),
        exact: true,
        precision: None,
        constants: None,
        written: Vec::new(),
        rounded_by: None,
        residues: Vec::new(),
    };
    report.size = Size {
        links: 3,
        joints: 3,
        loops: 1,
        couplings: 0,
        freedoms: 3,
    };
    report.kutzbach = -3;
    report.generic = Some(GenericCount {
        mobility: 0,
        redundant: 3,
    });
    report.home = Home {
        pose: Some(PoseKind::Singular),
        kind: Some(SingularKind::Shaky),
        redundant: Some(4),
        rank: Some(2),
        unknowns: 3,
        as_written: None,
        dropped: None,
        ..report.home
    };
    report.mobility = Mobility {
        verdict: Verdict::Rigid,
        finite: Some(0),
        bounds: [Some(0), Some(0)],
        complex_dimension: Some(0),
        class: None,
        certificate: Some(Certificate {
            level: CertificateLevel::Exact,
            text: "a self-stress is definite on the instantaneous freedom".to_owned(),
        }),
        nominal: None,
        as_written: None,
        why: Vec::new(),
    };
    report.branches = Some(Vec::new());
    report.joints.pop();
    report.cycles[0].joints.pop();
    report.cycles[0].space = Some("G".to_owned());
    report.cycles[0].space_text = "motion in the plane normal to z".to_owned();
    report.cycles[0].dimension = Some(3);
    report.cycles[0].rank = Some(2);
    report.cycles[0].redundant = Some(4);
    report.motions.clear();
    report.advice.clear();
    report
}

/// What an analysis of first order leaves of Bennett's loop.
pub(crate) fn undecided() -> Report {
    let mut report = mobile();
    report.home.pose = None;
    report.home.as_written = None;
    report.mobility = Mobility {
        verdict: Verdict::Undecided,
        finite: None,
        bounds: [Some(0), Some(1)],
        complex_dimension: None,
        class: None,
        certificate: None,
        nominal: None,
        as_written: None,
        why: vec!["the rank bounds the finite freedom from above only".to_owned()],
    };
    report.branches = None;
    report.motions.clear();
    report
}

/// A loop that does not close.
pub(crate) fn unassembled() -> Report {
    let mut report = undecided();
    report.mobility.verdict = Verdict::Unassembled;
    report.mobility.bounds = [None, None];
    report.mobility.why = Vec::new();
    report.assembly = Assembly {
        closed: Some(false),
        residual: Some(0.3),
        moved: Some(1.2),
        tolerance: Some(1e-11),
        gaps: vec![Gap {
            cycle: "J3".to_owned(),
            position: 0.5,
            angle: 0.4,
            left_position: 0.3,
            left_angle: 0.2,
        }],
        starts: Some(264),
        ..Assembly::default()
    };
    report.home = Home {
        instantaneous: None,
        candidates: [0, 4],
        redundant: None,
        rank: None,
        gap: None,
        kept: None,
        dropped: None,
        method: String::new(),
        bits: None,
        blocks: Vec::new(),
        ..report.home
    };
    for joint in &mut report.joints {
        joint.locked = None;
        joint.redundant_wrenches = None;
    }
    report.cycles[0].rank = None;
    report.cycles[0].redundant = None;
    report.cycles[0].mobility = None;
    report.advice.clear();
    report
}

/// Names that try to steer the terminal, break the table and reverse the line.
pub(crate) fn hostile() -> Report {
    let mut report = mobile();
    report.mechanism = "\u{1b}]0;owned\u{7}bennett".to_owned();
    report.joints[0].name = "\u{1b}[2J\u{1b}[31mJ1".to_owned();
    report.joints[1].name = "line\nbreak\ttab".to_owned();
    report.joints[2].name = "\u{202e}reversed\u{200b}".to_owned();
    report.joints[3].name = "x".repeat(5000);
    report.joints[3].links[0] = "关节".repeat(100);
    report.cycles[0].joints = report.joints.iter().map(|j| j.name.clone()).collect();
    let text = "link `\u{9b}31m` \r\n has no mass";
    report.warnings = vec![Warning::new(WarningKind::Said, text)];
    report
}

/// A chain of 200 hinges.
pub(crate) fn large() -> Report {
    let mut report = undecided();
    report.joints = (1..=200)
        .map(|n| {
            revolute(
                &format!("J{n}"),
                [&format!("L{}", n - 1), &format!("L{n}")],
                false,
            )
        })
        .collect();
    report.cycles[0].joints = report.joints.iter().map(|j| j.name.clone()).collect();
    let warning = |n| Warning::new(WarningKind::Said, format!("warning {n}"));
    report.warnings = (0..20).map(warning).collect();
    report
}
