//! The first screen of a robot of forty joints is one page.

use kutzbach::report::text::{Layout, render};
use kutzbach::report::{Options, analysed_report};

/// Lines of a page.
const PAGE: usize = 60;

/// A humanoid: two arms and two legs of seven joints, and two hands of three fingers of two joints.
fn humanoid() -> String {
    let mut text = "<robot name='humanoid'><link name='pelvis'/>".to_owned();
    let mut joint = |name: &str, parent: &str, child: &str, place: &str, axis: &str| {
        text.push_str(&format!(
            "<link name='{child}'/><joint name='{name}' type='revolute'><parent link='{parent}'/><child link='{child}'/>\
             <origin xyz='{place}'/><axis xyz='{axis}'/><limit lower='-2' upper='2' effort='1' velocity='1'/></joint>\n"
        ));
    };
    let axes = ["1 0 0", "0 1 0", "0 0 1"];
    for side in ["left", "right"] {
        for limb in ["arm", "leg"] {
            let mut parent = "pelvis".to_owned();
            for i in 1..=7 {
                let child = format!("{side}_{limb}_{i}");
                joint(
                    &format!("{child}_joint"),
                    &parent,
                    &child,
                    "0 0.1 0.2",
                    axes[i % 3],
                );
                parent = child;
            }
            if limb == "arm" {
                for finger in 1..=3 {
                    let mut parent = parent.clone();
                    for part in 1..=2 {
                        let child = format!("{side}_finger_{finger}_{part}");
                        joint(
                            &format!("{child}_joint"),
                            &parent,
                            &child,
                            "0 0.02 0.03",
                            "1 0 0",
                        );
                        parent = child;
                    }
                }
            }
        }
    }
    text.push_str("</robot>");
    text
}

#[test]
fn a_robot_of_forty_joints_fits_a_page() {
    let text = humanoid();
    let reading = kutzbach::format::read(&text, "humanoid", &[]).unwrap();
    assert_eq!(reading.mechanism.joints().len(), 40);
    let options = Options {
        ranges: true,
        ..Options::default()
    };
    let report = analysed_report(&reading, "humanoid", &options).unwrap().0;
    let page = render(&report, Layout::default());
    let lines = page.lines().count();
    println!("{page}\n{lines} lines");
    assert!(lines <= PAGE, "{lines} lines:\n{page}");
}
