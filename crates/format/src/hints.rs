//! What a writer may have meant who used another language's words: names of joints, and units behind numbers.

/// The joint type that goes by another name elsewhere.
pub(super) fn joint_type(word: &str) -> Option<&'static str> {
    let word = word.to_lowercase().replace(['-', ' '], "_");
    Some(match word.trim_end_matches("_joint") {
        "hinge" | "pin" | "pivot" | "rotary" | "rotational" => "revolute",
        "ball" | "ball_and_socket" | "ball_socket" | "socket" => "spherical",
        "slider" | "slide" | "sliding" | "linear" => "prismatic",
        "helical" | "helix" => "screw",
        "cardan" | "hooke" | "hookes" | "gimbal" => "universal",
        "weld" | "welded" | "rigid" => "fixed",
        "free" | "6dof" => "floating",
        _ => return None,
    })
}

/// How a number with a unit behind it is written: `2mm` as `0.002`.
pub(super) fn without_unit(token: &str) -> Option<String> {
    let end = token.find(|c: char| c.is_alphabetic() || c == '°')?;
    let (number, unit) = token.split_at(end);
    number.parse::<f64>().ok()?;
    let (measure, text) = match unit {
        "mm" => ("lengths are in metres", format!("${{{number}/1000}}")),
        "cm" => ("lengths are in metres", format!("${{{number}/100}}")),
        "m" => ("lengths are in metres", number.to_owned()),
        "in" | "inch" => ("lengths are in metres", format!("${{{number}*0.0254}}")),
        "deg" | "°" => ("angles are in radians", format!("${{{number}*pi/180}}")),
        "rad" => ("angles are in radians", number.to_owned()),
        _ => return None,
    };
    Some(format!("{measure}, without a unit: write {text}"))
}

/// A joint of the tree and one that closes a loop name their links by different words.
pub(super) fn side_of_joint(element: &str, parent: &str) -> Option<String> {
    let meant = match (parent, element) {
        ("joint", "predecessor") => "parent",
        ("joint", "successor") => "child",
        ("loop", "parent") => "predecessor",
        ("loop", "child") => "successor",
        _ => return None,
    };
    let both = "<joint> has <parent> and <child>; <loop>, which closes a loop, has <predecessor> and <successor>";
    Some(format!("write <{meant}>: {both}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_have_other_names_elsewhere() {
        assert_eq!(joint_type("Hinge"), Some("revolute"));
        assert_eq!(joint_type("ball-and-socket"), Some("spherical"));
        assert_eq!(joint_type("slider_joint"), Some("prismatic"));
        assert_eq!(joint_type("revolute"), None);
    }

    #[test]
    fn units_are_taken_for_factors() {
        let told = |token| without_unit(token).unwrap_or_default();
        assert!(told("2mm").ends_with("write ${2/1000}"));
        assert!(told("-90deg").ends_with("write ${-90*pi/180}"));
        assert!(told("1.5m").ends_with("write 1.5"));
        for other in ["1e3", "x", "mm", "2 mm", "1e-3q"] {
            assert_eq!(without_unit(other), None, "{other}");
        }
    }
}
