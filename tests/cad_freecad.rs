//! Assemblies of FreeCAD as it saves them: documents, and what is no file of a CAD program that is read.

use kutzbach::format::{WarningKind, read};
use kutzbach::mechanism::{JointId, Mechanism};
use kutzbach::mobility::{AnalysisOptions, analyse};
use std::fmt::Write as _;

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
    let unpacked = kutzbach::format::read_bytes(&zipped(&text), "crank.FCStd", &[]).unwrap();
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

/// FreeCAD prints sixteen decimals. Lengths in whole millimetres were taken for rounded to the millimetre.
#[test]
fn whole_millimetres_are_exact() {
    let reading = |length: &str| {
        let text = crank_slider("").replace("PointLike", "Slider");
        let text = text.replace("Px=\"60\"", &format!("Px=\"{length}\""));
        read(&text, "Document.xml", &[]).unwrap()
    };
    let is_exact = |mechanism: &Mechanism| {
        let mut joints = (0..mechanism.joints().len()).map(JointId);
        joints.all(|joint| mechanism.precision_of(joint).is_exact())
    };
    for length in ["60", "60.", "60.0000000000000000", "-60.0"] {
        assert!(is_exact(&reading(length).mechanism), "{length}");
    }
    assert!(!is_exact(&reading("60.1234").mechanism));
}

#[test]
fn a_joint_that_is_listed_twice_is_one() {
    let text = crank_slider("").replace("PointLike", "Slider");
    let listed = "<Link value=\"Joint1\"/>";
    let twice = text.replace(listed, &listed.repeat(2));
    assert_ne!(text, twice);
    let [once, twice] = [text, twice].map(|text| read(&text, "Document.xml", &[]).unwrap());
    assert_eq!(
        once.mechanism.joints().len(),
        twice.mechanism.joints().len()
    );
}

fn zipped(text: &str) -> Vec<u8> {
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    archive
        .start_file("Document.xml", zip::write::SimpleFileOptions::default())
        .unwrap();
    std::io::Write::write_all(&mut archive, text.as_bytes()).unwrap();
    archive.finish().unwrap().into_inner()
}

#[test]
fn faults_inside_a_zip_file_have_their_places() {
    let folder = crate::support::empty_folder("freecad_faults");
    for (wrong, told) in [
        ("Px=\"8O\"", "`8O` is no number"),
        ("Px=\"1e300\"", "the number is too large"),
    ] {
        let text = crank_slider("").replace("PointLike", "Slider");
        let bytes = zipped(&text.replace("Px=\"80\"", wrong));
        std::fs::write(folder.join("crank.FCStd"), bytes).unwrap();
        let mut program = crate::support::program();
        program.current_dir(&folder).args(["report", "crank.FCStd"]);
        let output = program.output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        let said = said.replace("\n  │ ", " ");
        assert!(
            said.contains("Document.xml:3:") && said.contains(told),
            "{said}"
        );
    }
}
