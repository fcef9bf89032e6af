//! Assemblies of CAD programs: what their joints become, against what they leave free.

use kutzbach::format::{FormatError, Reading, WarningKind, read};
use kutzbach::mobility::{AnalysisOptions, analyse};
use std::fmt::Write as _;

/// A block of ASMT: its word, and lines further in.
fn block(depth: usize, word: &str, said: &[&str]) -> String {
    let mut text = format!("{}{word}\n", "\t".repeat(depth));
    for line in said {
        let _ = writeln!(text, "{}{line}", "\t".repeat(depth + 1));
    }
    text
}

const STRAIGHT: [&str; 3] = ["1 0 0", "0 1 0", "0 0 1"];

/// A part, or the model at depth 1, with its markers: names, positions and rows of their rotations.
fn part(depth: usize, at: [&str; 2], markers: &[(&str, &str, [&str; 3])]) -> String {
    let [name, position] = at;
    let mut text = block(depth, "Name", &[name]);
    text += &block(depth, "Position3D", &[position]);
    text += &block(depth, "RotationMatrix", &STRAIGHT);
    text += &block(depth, "RefPoints", &[]);
    for (name, position, rows) in markers {
        text += &block(depth + 1, "RefPoint", &[]);
        text += &block(depth + 2, "Position3D", &["0 0 0"]);
        text += &block(depth + 2, "RotationMatrix", &STRAIGHT);
        text += &block(depth + 2, "Markers", &["Marker"]);
        text += &block(depth + 4, "Name", &[name]);
        text += &block(depth + 4, "Position3D", &[position]);
        text += &block(depth + 4, "RotationMatrix", rows);
    }
    text
}

/// A model: markers of the ground, parts with their markers, and joints with markers and further lines.
struct Model {
    parts: String,
    ground: String,
    sets: String,
}

impl Model {
    fn new(markers: &[(&str, &str, [&str; 3])]) -> Self {
        Self {
            parts: block(1, "Parts", &[]),
            ground: part(1, ["Rig", "0 0 0"], markers),
            sets: block(1, "ConstraintSets", &["Joints"]),
        }
    }

    fn part(mut self, name: &str, position: &str, markers: &[(&str, &str, [&str; 3])]) -> Self {
        self.parts += &block(2, "Part", &[]);
        self.parts += &part(3, [name, position], markers);
        self
    }

    fn joint(mut self, kind: &str, name: &str, sides: [&str; 2], more: &[(&str, &str)]) -> Self {
        self.sets += &block(3, kind, &[]);
        self.sets += &block(4, "Name", &[name]);
        for (word, side) in ["MarkerI", "MarkerJ"].iter().zip(sides) {
            self.sets += &block(4, word, &[&format!("/Rig/{side}")]);
        }
        for (word, value) in more {
            self.sets += &block(4, word, &[value]);
        }
        self
    }

    fn text(&self) -> String {
        format!(
            "OndselSolver\nAssembly\n{}{}{}",
            self.ground, self.parts, self.sets
        )
    }

    fn read(&self) -> Result<Reading, FormatError> {
        read(&self.text(), "model.asmt", &[])
    }

    fn finite(&self) -> Option<usize> {
        let reading = self.read().unwrap_or_else(|error| panic!("{error}"));
        let analysis = analyse(&reading.mechanism, &AnalysisOptions::default()).unwrap();
        analysis.mobility.finite()
    }
}

/// A body that one joint of a kind holds to the ground.
fn one_joint(kind: &str, ground: [&str; 3], more: &[(&str, &str)], at: &str) -> Model {
    Model::new(&[("g", "0 0 0", ground)])
        .part("body", at, &[("b", "0 0 0", STRAIGHT)])
        .joint(kind, "joint", ["g", "body/b"], more)
}

#[test]
fn each_kind_of_joint_leaves_its_freedoms() {
    let tilted = ["1 0 0", "0 0.6 0.8", "0 -0.8 0.6"];
    let across = ["1 0 0", "0 0 -1", "0 1 0"];
    let rod = [("distanceIJ", "2")];
    for (kind, ground, more, at, expected) in [
        ("FixedJoint", STRAIGHT, &[][..], "0 0 0", 0),
        ("RevoluteJoint", STRAIGHT, &[], "0 0 0", 1),
        ("CylindricalJoint", STRAIGHT, &[], "0 0 0.3", 2),
        ("TranslationalJoint", STRAIGHT, &[], "0 0 0.3", 1),
        ("SphericalJoint", tilted, &[], "0 0 0", 3),
        ("UniversalJoint", across, &[], "0 0 0", 2),
        ("PlanarJoint", STRAIGHT, &[("offset", "0.2")], "1 2 0.2", 3),
        (
            "PointInPlaneJoint",
            STRAIGHT,
            &[("offset", "0.2")],
            "1 2 0.2",
            5,
        ),
        ("LineInPlaneJoint", across, &[("offset", "0")], "1 0 0.2", 4),
        ("PointInLineJoint", STRAIGHT, &[], "0 0 0.7", 4),
        ("ParallelAxesJoint", STRAIGHT, &[], "1 2 3", 4),
        ("NoRotationJoint", STRAIGHT, &[], "1 2 3", 3),
        ("PerpendicularJoint", across, &[], "1 2 3", 5),
        (
            "AngleJoint",
            tilted,
            &[("theIzJz", "0.9272952180016122")],
            "1 2 3",
            5,
        ),
        ("AngleJoint", STRAIGHT, &[("theIzJz", "0.0")], "1 2 3", 4),
        // Both sides of what FreeCAD takes for parallel axes.
        ("AngleJoint", STRAIGHT, &[("theIzJz", "9e-8")], "1 2 3", 4),
        ("AngleJoint", STRAIGHT, &[("theIzJz", "1.1e-7")], "1 2 3", 5),
        ("RevRevJoint", STRAIGHT, &rod, "1.2 1.6 0", 2),
        ("RevCylJoint", STRAIGHT, &rod, "1.2 1.6 3", 3),
        ("CylSphJoint", STRAIGHT, &rod, "1.2 1.6 3", 5),
        ("SphSphJoint", STRAIGHT, &rod, "0 1.2 1.6", 5),
        ("RevRevJoint", STRAIGHT, &[], "0 0 0", 1),
        ("CylSphJoint", STRAIGHT, &[], "0 0 3", 4),
    ] {
        let model = one_joint(kind, ground, more, at);
        assert_eq!(model.finite(), Some(expected), "{kind}\n{}", model.text());
        // Nothing is lost beside the joint.
        let told: Vec<_> = model.read().unwrap().warnings;
        assert!(
            !told.iter().any(|w| w.kind.is_told_first()),
            "{kind} {told:?}"
        );
    }
}

#[test]
fn axes_that_point_against_one_another_are_one_axis() {
    let down = ["1 0 0", "0 -1 0", "0 0 -1"];
    let round = ["-1 0 0", "0 -1 0", "0 0 1"];
    for (kind, rows, expected) in [
        ("RevoluteJoint", down, 1),
        ("CylindricalJoint", down, 2),
        ("TranslationalJoint", down, 1),
        ("TranslationalJoint", round, 1),
        ("FixedJoint", round, 0),
        ("PlanarJoint", down, 3),
    ] {
        assert_eq!(
            one_joint(kind, rows, &[], "0 0 0").finite(),
            Some(expected),
            "{kind} {rows:?}"
        );
    }
}

/// A slide along x and a wheel about z on the ground.
fn slide_and_wheel(kind: &str, more: &[(&str, &str)], slide: [&str; 3]) -> Model {
    Model::new(&[("s", "0 0 0", slide), ("w", "0 1 0", STRAIGHT)])
        .part(
            "rack",
            "0.3 0 0",
            &[("m", "0 0 0", slide), ("c", "0 0 0", STRAIGHT)],
        )
        .part("wheel", "0 1 0", &[("m", "0 0 0", STRAIGHT)])
        .joint("TranslationalJoint", "slide", ["s", "rack/m"], &[])
        .joint("RevoluteJoint", "turn", ["w", "wheel/m"], &[])
        .joint(kind, "tied", ["rack/c", "wheel/m"], more)
}

#[test]
fn gears_racks_and_screws_tie_what_bears_their_parts() {
    let along_x = ["0 0 1", "1 0 0", "0 1 0"];
    let rack = slide_and_wheel("RackPinionJoint", &[("pitchRadius", "0.5")], along_x);
    let screw = slide_and_wheel("ScrewJoint", &[("pitch", "0.01")], STRAIGHT);
    for (model, factors) in [
        (&rack, [-1.0, 0.5]),
        (&screw, [-std::f64::consts::TAU, -0.01]),
    ] {
        assert_eq!(model.finite(), Some(1), "{}", model.text());
        let mechanism = model.read().unwrap().mechanism;
        let terms = &mechanism.couplings()[0].terms;
        let found: Vec<f64> = terms.iter().map(|term| term.factor.value()).collect();
        assert_eq!(found, factors);
    }
    // The rack is drawn 0.3 m along its slide: no pose is lost by the coupling.
    let offset = rack.read().unwrap().mechanism.couplings()[0].offset.value();
    assert!((offset + 0.3).abs() < 1e-12, "{offset}");
    // Drawn at zero two kilometres away, the slide is off by what rounding leaves, 2e-13: the coupling has no offset.
    let far = Model::new(&[("s", "2000.4 0 0", along_x), ("w", "0 1 0", STRAIGHT)])
        .part(
            "rack",
            "2000.1 0 0",
            &[("m", "0.3 0 0", along_x), ("c", "0 0 0", STRAIGHT)],
        )
        .part("wheel", "0 1 0", &[("m", "0 0 0", STRAIGHT)])
        .joint("TranslationalJoint", "slide", ["s", "rack/m"], &[])
        .joint("RevoluteJoint", "turn", ["w", "wheel/m"], &[])
        .joint(
            "RackPinionJoint",
            "tied",
            ["rack/c", "wheel/m"],
            &[("pitchRadius", "0.5")],
        );
    assert!(
        far.read().unwrap().mechanism.couplings()[0]
            .offset
            .is_zero()
    );
    // What is drawn a picometre off is no rounding of a metre.
    let near = slide_and_wheel("RackPinionJoint", &[("pitchRadius", "0.5")], along_x);
    let near = near.text().replace("0.3 0 0", "0.000000000001 0 0");
    let near = read(&near, "model.asmt", &[]).unwrap().mechanism;
    assert!((near.couplings()[0].offset.value() + 1e-12).abs() < 1e-14);
    // On one axis, a screw and a cylindrical joint are a screw joint.
    let nut = one_joint("CylindricalJoint", STRAIGHT, &[], "0 0 0.2").joint(
        "ScrewJoint",
        "thread",
        ["g", "body/b"],
        &[("pitch", "0.01")],
    );
    assert_eq!(nut.finite(), Some(1));
    // Parts that nothing bears on one body are told, not left out in silence.
    let loose = one_joint("SphericalJoint", STRAIGHT, &[], "0 0 0").joint(
        "GearJoint",
        "gears",
        ["g", "body/b"],
        &[("radiusI", "1"), ("radiusJ", "2")],
    );
    let told = loose.read().unwrap().warnings;
    assert!(
        told.iter().any(|w| w.kind == WarningKind::MayJoin),
        "{told:?}"
    );
}

#[test]
fn a_four_bar_is_one_whatever_its_solver_left() {
    // Drawn by a solver that stopped at 1e-9, in the decimals that it prints.
    let hinges = [("a", "0 0 0", STRAIGHT), ("d", "2 0 0", STRAIGHT)];
    let model = Model::new(&hinges)
        .part(
            "crank",
            "0 1.0000000003e-10 0",
            &[("o", "0 0 0", STRAIGHT), ("b", "0 1 0", STRAIGHT)],
        )
        .part(
            "coupler",
            "2.9999e-10 1.0 0",
            &[("b", "0 0 0", STRAIGHT), ("c", "2 0 0", STRAIGHT)],
        )
        .part(
            "rocker",
            "2.0 0 0",
            &[("o", "0 0 0", STRAIGHT), ("c", "0 1 0", STRAIGHT)],
        )
        .joint("RevoluteJoint", "A", ["a", "crank/o"], &[])
        .joint("RevoluteJoint", "B", ["crank/b", "coupler/b"], &[])
        .joint("RevoluteJoint", "C", ["coupler/c", "rocker/c"], &[])
        .joint("RevoluteJoint", "D", ["d", "rocker/o"], &[]);
    assert_eq!(model.finite(), Some(1));
}

#[test]
fn faults_of_asmt_have_their_places() {
    let unknown = one_joint("CurveCurveContact", STRAIGHT, &[], "0 0 0")
        .read()
        .unwrap();
    let told = unknown
        .warnings
        .iter()
        .find(|w| w.kind == WarningKind::MayJoin);
    let text = one_joint("CurveCurveContact", STRAIGHT, &[], "0 0 0").text();
    let line = text
        .lines()
        .position(|line| line.trim() == "CurveCurveContact")
        .unwrap();
    assert_eq!(told.unwrap().line, line + 1);
    let lost = one_joint("RevoluteJoint", STRAIGHT, &[], "0 0 0")
        .joint("RevoluteJoint", "second", ["g", "body/lost"], &[])
        .read()
        .unwrap_err();
    assert_eq!(lost.message, "there is no marker `/Rig/body/lost`");
    let sheared = ["1 0.3 0", "0 1 0", "0 0 1"];
    let sheared = one_joint("RevoluteJoint", sheared, &[], "0 0 0")
        .read()
        .unwrap_err();
    assert!(sheared.message.contains("no rotation"), "{sheared}");
    let mirrored = ["1 0 0", "0 1 0", "0 0 -1"];
    assert!(
        one_joint("RevoluteJoint", mirrored, &[], "0 0 0")
            .read()
            .is_err()
    );
}

/// A document of FreeCAD: parts at places, each a body with a placement inside, and joints.
struct Document {
    objects: String,
    data: String,
    names: Vec<String>,
    joints: Vec<String>,
}

fn property(name: &str, inner: &str) -> String {
    format!("<Property name=\"{name}\">{inner}</Property>")
}

fn placed(name: &str, [x, y, z]: [&str; 3], quaternion: [&str; 4]) -> String {
    let [i, j, k, w] = quaternion;
    property(
        name,
        &format!(
            "<PropertyPlacement Px=\"{x}\" Py=\"{y}\" Pz=\"{z}\" Q0=\"{i}\" Q1=\"{j}\" Q2=\"{k}\" Q3=\"{w}\"/>"
        ),
    )
}

const UNTURNED: [&str; 4] = ["0", "0", "0", "1"];

impl Document {
    fn new() -> Self {
        Self {
            objects: String::new(),
            data: String::new(),
            names: Vec::new(),
            joints: Vec::new(),
        }
    }

    fn object(mut self, kind: &str, name: &str, properties: &str) -> Self {
        let _ = write!(self.objects, "<Object type=\"{kind}\" name=\"{name}\"/>");
        let _ = write!(
            self.data,
            "<Object name=\"{name}\"><Properties>{properties}</Properties></Object>"
        );
        self
    }

    /// A part and the body in it, whose own placement lies 10 mm along z.
    fn part(mut self, name: &str, at: [&str; 3]) -> Self {
        self.names.push(name.to_owned());
        let body = format!("{name}Body");
        self.object("App::Part", name, &placed("Placement", at, UNTURNED))
            .object(
                "PartDesign::Body",
                &body,
                &placed("Placement", ["0", "0", "10"], UNTURNED),
            )
    }

    fn ground(mut self, part: &str) -> Self {
        self.joints.push("GroundedJoint".to_owned());
        let link = format!("<Link value=\"{part}\"/>");
        self.object(
            "App::FeaturePython",
            "GroundedJoint",
            &property("ObjectToGround", &link),
        )
    }

    /// A joint between faces of two bodies, at points in them (mm).
    fn joint(mut self, kind: &str, ends: [(&str, [&str; 3]); 2], more: &str) -> Self {
        let name = format!("Joint{}", self.joints.len());
        let list = "<CustomEnumList count=\"1\"><Enum value=\"KIND\"/></CustomEnumList>";
        let kind = format!(
            "<Integer value=\"0\" CustomEnum=\"true\"/>{}",
            list.replace("KIND", kind)
        );
        let mut said = property("JointType", &kind);
        for (i, (part, at)) in ends.iter().enumerate() {
            let reference = format!(
                "<XLink file=\"\" name=\"Assembly\" count=\"2\"><Sub value=\"{part}.{part}Body.Pad.Face1\"/><Sub value=\"{part}.{part}Body.Pad.Face1\"/></XLink>"
            );
            said += &property(&format!("Reference{}", i + 1), &reference);
            said += &placed(&format!("Placement{}", i + 1), *at, UNTURNED);
        }
        self.joints.push(name.clone());
        self.object("App::FeaturePython", &name, &(said + more))
    }

    fn text(self) -> String {
        let links = |names: &[String]| {
            let all: String = names
                .iter()
                .map(|n| format!("<Link value=\"{n}\"/>"))
                .collect();
            property("Group", &format!("<LinkList>{all}</LinkList>"))
        };
        let mut inside = self.names.clone();
        inside.push("Joints".to_owned());
        let (groups, joints) = (links(&inside), links(&self.joints));
        let whole = self
            .object("Assembly::AssemblyObject", "Assembly", &groups)
            .object("Assembly::JointGroup", "Joints", &joints);
        format!(
            "<?xml version='1.0' encoding='utf-8'?>\n<Document SchemaVersion=\"4\"><Objects>{}</Objects>\n<ObjectData>{}</ObjectData></Document>",
            whole.objects, whole.data
        )
    }
}

/// A crank-slider of three moving parts: a crank of 20 mm, a rod of 60 mm, drawn stretched.
fn crank_slider(more: &str) -> String {
    Document::new()
        .part("Base", ["0", "0", "0"])
        .part("Crank", ["0", "0", "0"])
        .part("Rod", ["20", "0", "0"])
        .part("Piston", ["80", "0", "0"])
        .ground("Base")
        .joint(
            "Revolute",
            [("Base", ["0", "0", "0"]), ("Crank", ["0", "0", "0"])],
            "",
        )
        .joint(
            "Revolute",
            [("Crank", ["20", "0", "0"]), ("Rod", ["0", "0", "0"])],
            "",
        )
        .joint(
            "Revolute",
            [("Rod", ["60", "0", "0"]), ("Piston", ["0", "0", "0"])],
            "",
        )
        .joint(
            "PointLike",
            [("Base", ["0", "0", "0"]), ("Piston", ["0", "0", "0"])],
            more,
        )
        .text()
}

#[test]
fn assemblies_of_freecad_are_read_without_their_shapes() {
    // The slide is along x: z axes of both frames are turned to x by hand.
    let text = crank_slider("").replace("PointLike", "Slider");
    let along_x = "Q0=\"0\" Q1=\"0.7071067811865476\" Q2=\"0\" Q3=\"0.7071067811865476\"";
    let at = text.rfind("name=\"Reference1\"").unwrap();
    let (before, after) = text.split_at(at);
    let slider = after.replacen("Q0=\"0\" Q1=\"0\" Q2=\"0\" Q3=\"1\"", along_x, 2);
    let text = format!("{before}{slider}");
    let reading = read(&text, "Document.xml", &[]).unwrap();
    assert_eq!(reading.format, "freecad");
    assert_eq!(reading.warnings, []);
    let mechanism = &reading.mechanism;
    // The body of each part lies 10 mm above it, and metres keep the digits of millimetres.
    let hinge = &mechanism.joints()[1];
    let frame = &hinge.predecessor.frame;
    assert_eq!(frame.position[2].value(), 0.01);
    let analysis = analyse(mechanism, &AnalysisOptions::default()).unwrap();
    assert_eq!(analysis.mobility.finite(), Some(1));
    // The same as a zip file.
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    archive
        .start_file("Document.xml", zip::write::SimpleFileOptions::default())
        .unwrap();
    std::io::Write::write_all(&mut archive, text.as_bytes()).unwrap();
    let bytes = archive.finish().unwrap().into_inner();
    let unpacked = kutzbach::format::read_bytes(&bytes, "crank.FCStd", &[]).unwrap();
    assert_eq!(unpacked.mechanism.joints().len(), mechanism.joints().len());
}

#[test]
fn joints_of_freecad_that_need_shapes_are_told() {
    let reading = read(
        &crank_slider("").replace("PointLike", "Distance"),
        "Document.xml",
        &[],
    );
    let told = reading.unwrap().warnings;
    assert!(
        matches!(&told[..], [one] if one.kind == WarningKind::MayJoin),
        "{told:?}"
    );
    let off = crank_slider("<Property name=\"Activated\"><Bool value=\"false\"/></Property>");
    let reading = read(&off.replace("PointLike", "Distance"), "Document.xml", &[]).unwrap();
    assert_eq!(reading.warnings, []);
    assert_eq!(reading.skipped[0].what, "joint that is switched off");
    let none = "<Document><Objects/><ObjectData/></Document>";
    let error = read(none, "Document.xml", &[]).unwrap_err();
    assert_eq!(error.message, "the document holds no assembly");
}

#[test]
fn what_cannot_be_read_is_named_with_what_to_do_instead() {
    use kutzbach::format::read_bytes;
    for (bytes, name) in [
        (&b"#usda 1.0\n"[..], "USD"),
        (b"PXR-USDC\0\x01\xff", "USD"),
        (b"glTF\x02\0\0\0\xff", "a file of shapes"),
        (b"joints: [a, b]\n", "YAML or a list of settings"),
    ] {
        let error = read_bytes(bytes, "file", &[]).unwrap_err();
        assert_eq!(error.message, format!("this is {name}, which is not read"));
        assert!(error.help.is_some());
    }
    // A zip file that is broken, or holds something else.
    let error = read_bytes(b"PK\x03\x04 broken", "file", &[]).unwrap_err();
    assert!(
        error.message.starts_with("the zip file cannot be unpacked"),
        "{error}"
    );
}
