//! Documents of FreeCAD: the part that a joint moves and the object that its frame is written in, by the rules of FreeCAD 1.0.0.

use kutzbach::format::{Reading, WarningKind, read};
use std::fmt::Write as _;

/// Objects: their types, names and further properties.
struct Document {
    objects: String,
    data: String,
}

fn property(name: &str, inner: &str) -> String {
    format!("<Property name=\"{name}\">{inner}</Property>")
}

/// A placement that moves along x (mm).
fn at(name: &str, x: &str) -> String {
    property(
        name,
        &format!(
            "<PropertyPlacement Px=\"{x}\" Py=\"0\" Pz=\"0\" Q0=\"0\" Q1=\"0\" Q2=\"0\" Q3=\"1\"/>"
        ),
    )
}

fn links(name: &str, to: &[&str]) -> String {
    let all: String = to
        .iter()
        .map(|name| format!("<Link value=\"{name}\"/>"))
        .collect();
    property(name, &format!("<LinkList>{all}</LinkList>"))
}

fn link_to(file: &str, name: &str) -> String {
    let link = format!("<XLink file=\"{file}\" stamp=\"\" name=\"{name}\"/>");
    property("LinkedObject", &link)
}

/// A joint between two paths below `root`, with frames at the origins of their objects.
fn joint(kind: &str, root: &str, paths: [&str; 2], more: &str) -> String {
    let list = "<CustomEnumList count=\"1\"><Enum value=\"KIND\"/></CustomEnumList>";
    let mut said = property(
        "JointType",
        &format!(
            "<Integer value=\"0\" CustomEnum=\"true\"/>{}",
            list.replace("KIND", kind)
        ),
    );
    for (i, path) in paths.iter().enumerate() {
        let subs = format!("<Sub value=\"{path}\"/>").repeat(2);
        let reference = format!("<XLink file=\"\" name=\"{root}\" count=\"2\">{subs}</XLink>");
        said += &property(&format!("Reference{}", i + 1), &reference);
        said += &at(&format!("Placement{}", i + 1), "0");
    }
    said + more
}

impl Document {
    /// An assembly of these objects, and one joint.
    fn new(group: &[&str], joint: &str) -> Self {
        let mut inside = group.to_vec();
        inside.push("Joints");
        Self {
            objects: String::new(),
            data: String::new(),
        }
        .object(
            "Assembly::AssemblyObject",
            "Assembly",
            &links("Group", &inside),
        )
        .object(
            "Assembly::JointGroup",
            "Joints",
            &links("Group", &["Joint"]),
        )
        .object("App::FeaturePython", "Joint", joint)
        .object("Part::Feature", "Base", &at("Placement", "0"))
    }

    fn object(mut self, kind: &str, name: &str, properties: &str) -> Self {
        let _ = write!(self.objects, "<Object type=\"{kind}\" name=\"{name}\"/>");
        let _ = write!(
            self.data,
            "<Object name=\"{name}\"><Properties>{properties}</Properties></Object>"
        );
        self
    }

    fn read(&self) -> Reading {
        let text = format!(
            "<Document SchemaVersion=\"4\"><Objects>{}</Objects><ObjectData>{}</ObjectData></Document>",
            self.objects, self.data
        );
        read(&text, "Document.xml", &[]).unwrap_or_else(|error| panic!("{error}"))
    }

    /// The link on the second side of the joint, and the height of the joint's frame on it along x (mm).
    fn second(&self) -> (String, f64) {
        let reading = self.read();
        assert_eq!(reading.warnings, []);
        let mechanism = &reading.mechanism;
        let joint = mechanism
            .joints()
            .iter()
            .find(|joint| joint.name == "Joint")
            .unwrap();
        let link = &mechanism.links()[joint.successor.link.0];
        let x = joint.successor.frame.position[0].value();
        (link.name.clone(), (x * 1e6).round() / 1e3)
    }

    /// Why the joint is not read.
    fn told(&self) -> String {
        let warnings = self.read().warnings;
        let [one] = &warnings[..] else {
            panic!("{warnings:?}")
        };
        assert_eq!(one.kind, WarningKind::MayJoin);
        one.message.clone()
    }
}

/// A hinge from the base to what a path below the assembly names.
fn to(path: &str) -> String {
    joint("Revolute", "Assembly", ["Base.Face1", path], "")
}

#[test]
fn features_of_a_body_are_in_its_frame_and_datums_in_their_own() {
    let document = |path: &str| {
        Document::new(&["Base", "Arm"], &to(path))
            .object("App::Part", "Arm", &at("Placement", "500"))
            .object("PartDesign::Body", "Body", &at("Placement", "10"))
            .object("PartDesign::Pad", "Pad", &at("Placement", "3"))
            .object("Sketcher::SketchObject", "Sketch", &at("Placement", "2"))
            .object(
                "PartDesign::CoordinateSystem",
                "Local_CS",
                &at("Placement", "7"),
            )
    };
    for (path, x) in [
        ("Arm.Body.Face1", 10.0),
        ("Arm.Body.Pad.Face1", 10.0),
        ("Arm.Body.Local_CS.X", 17.0),
        ("Arm.Body.Pad.Sketch.", 12.0),
        ("Arm.", 0.0),
    ] {
        assert_eq!(document(path).second(), ("Arm".to_owned(), x), "{path}");
    }
    let lost = document("Arm.Gone.Face1").told();
    assert!(lost.ends_with("is not in the document"), "{lost}");
    // A part that is gone is not the assembly itself.
    let lost = document("Gone.Face1").told();
    assert!(lost.ends_with("is not in the document"), "{lost}");
}

#[test]
fn what_a_link_leads_to_says_what_follows_it() {
    let document = |file: &str, to_what: &str, path: &str| {
        Document::new(&["Base", "Link"], &to(path))
            .object(
                "App::Link",
                "Link",
                &(at("Placement", "500") + &link_to(file, to_what)),
            )
            .object("App::Part", "Arm", &at("Placement", "40"))
            .object("PartDesign::Body", "Body", &at("Placement", "10"))
            .object("PartDesign::Pad", "Pad", &at("Placement", "3"))
    };
    // The link stands in the place of what it links to, which keeps its own placement.
    for (to_what, path, x) in [
        ("Body", "Link.Pad.Face1", 0.0),
        ("Body", "Link.Face1", 0.0),
        ("Arm", "Link.Body.Pad.Face1", 10.0),
    ] {
        assert_eq!(document("", to_what, path).second(), ("Link".to_owned(), x));
    }
    // `Body` of the other file is not the one here.
    let elsewhere = document("arm.FCStd", "Arm", "Link.Body.Face1").told();
    assert!(elsewhere.ends_with("lies in another file"), "{elsewhere}");
    let whole = document("arm.FCStd", "Body", "Link.Face1").second();
    assert_eq!(whole, ("Link".to_owned(), 0.0));
}

#[test]
fn the_part_that_moves_is_the_first_that_is_no_group() {
    let arm = |document: Document| document.object("Part::Box", "Box", &at("Placement", "7"));
    // The assembly lies in a part.
    let within = joint(
        "Revolute",
        "Outer",
        ["Assembly.Base.Face1", "Assembly.Box.Face1"],
        "",
    );
    let document = arm(Document::new(&["Base", "Box"], &within)).object(
        "App::Part",
        "Outer",
        &at("Placement", "90"),
    );
    assert_eq!(document.second(), ("Box".to_owned(), 0.0));
    // Parts lie in a folder.
    let document = arm(Document::new(&["Base", "Folder"], &to("Folder.Box.Face1"))).object(
        "App::DocumentObjectGroup",
        "Folder",
        &links("Group", &["Box"]),
    );
    assert_eq!(document.second(), ("Box".to_owned(), 0.0));
    // An assembly inside moves as a whole, and so does a rigid link to one.
    for (kind, more) in [
        ("Assembly::AssemblyObject", ""),
        (
            "Assembly::AssemblyLink",
            "<Property name=\"Rigid\"><Bool value=\"true\"/></Property>",
        ),
    ] {
        let document = arm(Document::new(&["Base", "Inner"], &to("Inner.Box.Face1"))).object(
            kind,
            "Inner",
            &(at("Placement", "90") + more),
        );
        assert_eq!(document.second(), ("Inner".to_owned(), 7.0), "{kind}");
    }
    let flexible = "<Property name=\"Rigid\"><Bool value=\"false\"/></Property>";
    let document = arm(Document::new(&["Base", "Inner"], &to("Inner.Box.Face1"))).object(
        "Assembly::AssemblyLink",
        "Inner",
        flexible,
    );
    assert!(document.told().contains("flexible"));
    // Elements of an array move by themselves.
    let count = "<Property name=\"ElementCount\"><Integer value=\"2\"/></Property>";
    let document = arm(Document::new(
        &["Base", "Array"],
        &to("Array.Array_i1.Face1"),
    ))
    .object("App::Link", "Array", &(link_to("", "Box") + count))
    .object(
        "App::LinkElement",
        "Array_i1",
        &(at("Placement", "20") + &link_to("", "Box")),
    );
    assert_eq!(document.second(), ("Array_i1".to_owned(), 0.0));
    // The origin of the assembly is the assembly.
    let document = Document::new(&["Base", "Origin"], &to("Origin.Z_Axis."))
        .object("App::Origin", "Origin", "")
        .object("App::Line", "Z_Axis", &at("Placement", "0"));
    assert_eq!(document.second(), ("Assembly".to_owned(), 0.0));
}

#[test]
fn limits_of_cylindrical_joints_are_told() {
    let more = property("EnableLengthMax", "<Bool value=\"true\"/>")
        + &property("LengthMax", "<Float value=\"5\"/>");
    let said = joint(
        "Cylindrical",
        "Assembly",
        ["Base.Face1", "Box.Face1"],
        &more,
    );
    let document =
        Document::new(&["Base", "Box"], &said).object("Part::Box", "Box", &at("Placement", "0"));
    let skipped = document.read().skipped;
    assert!(
        skipped
            .iter()
            .any(|one| one.what == "limit of a cylindrical joint"),
        "{skipped:?}"
    );
}

#[test]
fn what_grounds_a_part_is_no_part() {
    // FreeCAD writes joints into the group of the assembly as well.
    let ground = property("ObjectToGround", "<Link value=\"Base\"/>") + &at("Placement", "0");
    let document = Document::new(&["Base", "Box", "Joint", "Ground"], &to("Box.Face1"))
        .object("Part::Box", "Box", &at("Placement", "0"))
        .object("App::FeaturePython", "Ground", &ground);
    assert_eq!(document.read().skipped, []);
    let loose = Document::new(&["Base", "Box", "Rest"], &to("Box.Face1"))
        .object("Part::Box", "Box", &at("Placement", "0"))
        .object("Part::Box", "Rest", &at("Placement", "0"));
    let skipped = loose.read().skipped;
    assert_eq!(skipped[0].what, "part that no joint names");
}
