//! Robots that another reader has read already.

use crate::writer::escaped;
use crate::{FormatError, Reading, read};
use std::fmt::Write;
use urdf_rs::{Geometry, Inertial, Joint, JointLimit, JointType, Link, Pose, Robot};

/// What errors and warnings call the file.
const FILE: &str = "urdf_rs::Robot";

/// A robot of the crate `urdf_rs` (feature `urdf-rs`), read like the URDF text that [`urdf_text`] makes of it.
///
/// Numbers are doubles there: they are taken as their shortest decimals, which are those of the file unless that had zeros at the end or more than
/// 15 digits (so `1.5708` is known to four decimals, and `1.5707963267948966` is π/2). Bounds that are both zero are bounds that
/// the file does not have; so is an inertial without mass and inertia. Materials, transmissions, calibrations and safety controllers say nothing about motion
/// and are left out.
///
/// # Errors
/// [`FormatError`] where the robot is no mechanism, as for a file: names that occur twice or are not there, links that nothing connects, axes of length
/// zero, numbers that are not finite. Lines are those of the text.
///
/// ```
/// use kutzbach_format::Reading;
/// let robot = urdf_rs::read_from_string(r#"
///     <robot name="arm">
///       <link name="base"/> <link name="upper"/>
///       <joint name="shoulder" type="continuous">
///         <parent link="base"/> <child link="upper"/> <axis xyz="0 0 1"/>
///       </joint>
///     </robot>"#)?;
/// let reading = Reading::try_from(&robot)?;
/// assert_eq!(reading.mechanism.freedom(), 1);
///
/// let mut lost = robot.clone();
/// lost.joints[0].child.link = "lower".to_owned();
/// let error = Reading::try_from(&lost).unwrap_err();
/// assert!(error.to_string().contains("`lower`"), "{error}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl TryFrom<&Robot> for Reading {
    type Error = FormatError;

    fn try_from(robot: &Robot) -> Result<Self, FormatError> {
        read(&urdf_text(robot), FILE, &[])
    }
}

/// A robot as URDF: links with inertia, shapes and collision shapes, and joints with limits, dynamics and mimicry (m, kg, rad).
#[must_use]
pub fn urdf_text(robot: &Robot) -> String {
    let mut text = format!("<robot name=\"{}\">\n", escaped(&robot.name));
    robot.links.iter().for_each(|one| link(&mut text, one));
    robot.joints.iter().for_each(|one| joint(&mut text, one));
    text + "</robot>\n"
}

fn link(text: &mut String, link: &Link) {
    let _ = writeln!(text, "  <link name=\"{}\">", escaped(&link.name));
    inertial(text, &link.inertial);
    for shape in &link.visual {
        self::shape(
            text,
            "visual",
            shape.name.as_deref(),
            &shape.origin,
            &shape.geometry,
        );
    }
    for shape in &link.collision {
        self::shape(
            text,
            "collision",
            shape.name.as_deref(),
            &shape.origin,
            &shape.geometry,
        );
    }
    text.push_str("  </link>\n");
}

fn inertial(text: &mut String, inertial: &Inertial) {
    let (mass, inertia) = (inertial.mass.value, &inertial.inertia);
    let parts = [
        ("ixx", inertia.ixx),
        ("ixy", inertia.ixy),
        ("ixz", inertia.ixz),
        ("iyy", inertia.iyy),
        ("iyz", inertia.iyz),
        ("izz", inertia.izz),
    ];
    if mass == 0.0 && parts.iter().all(|(_, value)| *value == 0.0) {
        return;
    }
    let parts: Vec<String> = parts
        .iter()
        .map(|(name, value)| format!("{name}=\"{value}\""))
        .collect();
    let _ = writeln!(
        text,
        "    <inertial>{}<mass value=\"{mass}\"/><inertia {}/></inertial>",
        origin(&inertial.origin),
        parts.join(" ")
    );
}

fn shape(text: &mut String, tag: &str, name: Option<&str>, pose: &Pose, geometry: &Geometry) {
    let name = name.map_or(String::new(), |name| format!(" name=\"{}\"", escaped(name)));
    let geometry = match geometry {
        Geometry::Box { size } => format!("<box size=\"{}\"/>", vector(size)),
        Geometry::Cylinder { radius, length } => {
            format!("<cylinder radius=\"{radius}\" length=\"{length}\"/>")
        }
        Geometry::Capsule { radius, length } => {
            format!("<capsule radius=\"{radius}\" length=\"{length}\"/>")
        }
        Geometry::Sphere { radius } => format!("<sphere radius=\"{radius}\"/>"),
        Geometry::Mesh { filename, scale } => {
            let scale = scale.map_or(String::new(), |scale| {
                format!(" scale=\"{}\"", vector(&scale))
            });
            format!("<mesh filename=\"{}\"{scale}/>", escaped(filename))
        }
    };
    let _ = writeln!(
        text,
        "    <{tag}{name}>{}<geometry>{geometry}</geometry></{tag}>",
        origin(pose)
    );
}

fn joint(text: &mut String, joint: &Joint) {
    let kind = match joint.joint_type {
        JointType::Revolute => "revolute",
        JointType::Continuous => "continuous",
        JointType::Prismatic => "prismatic",
        JointType::Fixed => "fixed",
        JointType::Floating => "floating",
        JointType::Planar => "planar",
        JointType::Spherical => "spherical",
    };
    let [name, parent, child] =
        [&joint.name, &joint.parent.link, &joint.child.link].map(|name| escaped(name));
    let _ = writeln!(text, "  <joint name=\"{name}\" type=\"{kind}\">");
    let _ = writeln!(
        text,
        "    <parent link=\"{parent}\"/><child link=\"{child}\"/>{}",
        origin(&joint.origin)
    );
    // A direction that the joint has no use for is a default of the other reader.
    if matches!(kind, "revolute" | "continuous" | "prismatic" | "planar") {
        let _ = writeln!(text, "    <axis xyz=\"{}\"/>", vector(&joint.axis.xyz));
    }
    limit(text, joint);
    if let Some(dynamics) = &joint.dynamics {
        let _ = writeln!(
            text,
            "    <dynamics damping=\"{}\" friction=\"{}\"/>",
            dynamics.damping, dynamics.friction
        );
    }
    if let Some(mimic) = &joint.mimic {
        let attribute = |name: &str, value: Option<f64>| {
            value.map_or(String::new(), |value| format!(" {name}=\"{value}\""))
        };
        let _ = writeln!(
            text,
            "    <mimic joint=\"{}\"{}{}/>",
            escaped(&mimic.joint),
            attribute("multiplier", mimic.multiplier),
            attribute("offset", mimic.offset)
        );
    }
    text.push_str("  </joint>\n");
}

fn limit(text: &mut String, joint: &Joint) {
    let limit = &joint.limit;
    if *limit == JointLimit::default() {
        return;
    }
    let bounds = match joint.joint_type {
        // Bounds that the file does not have are zero, too.
        _ if limit.lower == 0.0 && limit.upper == 0.0 => String::new(),
        JointType::Revolute | JointType::Prismatic => {
            format!(" lower=\"{}\" upper=\"{}\"", limit.lower, limit.upper)
        }
        JointType::Continuous => String::new(),
        _ => return,
    };
    let most = [("effort", limit.effort), ("velocity", limit.velocity)];
    let most = most.iter().filter(|(_, value)| *value != f64::INFINITY);
    let most: String = most
        .map(|(name, value)| format!(" {name}=\"{value}\""))
        .collect();
    let _ = writeln!(text, "    <limit{bounds}{most}/>");
}

fn origin(pose: &Pose) -> String {
    let parts = [("xyz", &pose.xyz), ("rpy", &pose.rpy)];
    let stated = parts.iter().filter(|(_, values)| values.0 != [0.0; 3]);
    let stated: String = stated
        .map(|(name, values)| format!(" {name}=\"{}\"", vector(values)))
        .collect();
    match stated.is_empty() {
        true => stated,
        false => format!("<origin{stated}/>"),
    }
}

fn vector(vector: &urdf_rs::Vec3) -> String {
    vector.0.map(|value| value.to_string()).join(" ")
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const ARM: &str = r#"<robot name="arm &amp; hand">
      <link name="base"/>
      <link name="upper">
        <inertial><origin xyz="0 0 0.2"/><mass value="1.5"/>
          <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.01"/></inertial>
        <collision><origin xyz="0 0 0.2"/><geometry><box size="0.1 0.1 0.4"/></geometry></collision>
      </link>
      <link name="fore"><visual name="skin"><geometry><cylinder radius="0.05" length="0.3"/></geometry></visual></link>
      <link name="finger"/>
      <joint name="shoulder" type="revolute">
        <parent link="base"/><child link="upper"/><origin xyz="0 0 0.3333" rpy="1.5707963267948966 0 0"/>
        <axis xyz="0 1 0"/><limit lower="-1.2" upper="2" effort="10" velocity="3"/>
      </joint>
      <joint name="elbow" type="continuous">
        <parent link="upper"/><child link="fore"/><origin xyz="0 0 0.4"/><axis xyz="0 1 0"/>
        <dynamics damping="0.1" friction="0.2"/>
      </joint>
      <joint name="grip" type="prismatic">
        <parent link="fore"/><child link="finger"/><axis xyz="1 0 0"/>
        <limit lower="0" upper="0.05" effort="1" velocity="1"/><mimic joint="elbow" multiplier="0.01" offset="0.02"/>
      </joint>
    </robot>"#;

    fn robot() -> Robot {
        urdf_rs::read_from_string(ARM).unwrap()
    }

    /// What the other reader passes on is read as it is from the file itself.
    #[test]
    fn a_robot_is_the_mechanism_of_its_file() {
        let [of_robot, of_file] =
            [Reading::try_from(&robot()), read(ARM, "arm.urdf", &[])].map(Result::unwrap);
        assert_eq!(of_robot.mechanism.couplings().len(), 1);
        let [own, other] = [&of_robot, &of_file].map(|reading| crate::write(&reading.mechanism));
        assert_eq!(own, other);
        assert_eq!(of_robot.format, "urdf");
    }

    #[test]
    fn what_is_no_mechanism_is_refused() {
        let refused = |change: &dyn Fn(&mut Robot)| {
            let mut robot = robot();
            change(&mut robot);
            Reading::try_from(&robot).unwrap_err().to_string()
        };
        let nameless = refused(&|robot| robot.joints[1].parent.link = "elsewhere".to_owned());
        assert!(nameless.contains("`elsewhere`"), "{nameless}");
        let twice = refused(&|robot| robot.links[1].name = "base".to_owned());
        assert!(twice.contains("`base`"), "{twice}");
        let infinite = refused(&|robot| robot.joints[0].origin.xyz.0[2] = f64::NAN);
        assert!(infinite.contains("NaN"), "{infinite}");
        let no_axis = refused(&|robot| robot.joints[0].axis.xyz.0 = [0.0; 3]);
        assert!(no_axis.contains("urdf_rs::Robot:"), "{no_axis}");
        let markup = refused(&|robot| robot.joints[0].child.link = "\"/><x y=\"".to_owned());
        assert!(markup.contains("urdf_rs::Robot:"), "{markup}");
    }
}
