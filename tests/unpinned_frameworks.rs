//! Planar frameworks that nothing holds in place, at poses where a self-stress alone makes them rigid.

use crate::support;

use kutzbach::mobility::SingularKind;

/// Two regular polygons of `corners` corners about one centre, one of twice the size, each corner joined to its like: points that move
/// in the plane, and bars. It has as many bars as twice its points less `corners`, and turned by nothing it carries a self-stress.
///
/// ```text
///    o-----------o      corners = 4: inner and outer square,
///    | \       / |      a bar from each corner to its like
///    |  o-----o  |
///    |  |     |  |
///    |  o-----o  |
///    | /       \ |
///    o-----------o
/// ```
fn frustum(corners: usize) -> String {
    let mut text = format!(r#"<robot name="frustum_{corners}"><link name="room"/>"#);
    for point in 0..2 * corners {
        let (corner, size) = (point % corners, 1 + point / corners);
        let at = |function: &str| format!("${{{size}*{function}({}*pi/{corners})}}", 2 * corner);
        text += &format!(
            r#"<link name="v{point}"/><joint name="at_{point}" type="planar_translation"><parent link="room"/>
            <child link="v{point}"/><origin xyz="{} {} 0"/><axis xyz="0 0 1"/></joint>"#,
            at("cos"),
            at("sin"),
        );
    }
    let bars = (0..corners).flat_map(|corner| {
        let next = (corner + 1) % corners;
        [
            [corner, next],
            [corners + corner, corners + next],
            [corner, corners + corner],
        ]
    });
    for (index, [a, b]) in bars.enumerate() {
        text += &format!(
            r#"<loop name="rod_{index}" type="distance"><predecessor link="v{a}"/><successor link="v{b}"/></loop>"#
        );
    }
    text + "</robot>"
}

#[test]
fn a_stress_across_the_motions_of_the_whole_decides() {
    // Equations allow two more freedoms everywhere over the complex numbers, and the stress blocks them over the real ones: only the
    // three motions of the whole in its plane are left.
    let text = frustum(5);
    let reading = kutzbach::format::read(&text, "frustum.urdf", &[]).unwrap();
    let found = support::analysis(&reading.mechanism);
    assert_eq!(found.mobility.bounds, (Some(3), Some(3)));
    assert_eq!(found.mobility.kind, Some(SingularKind::PermanentlyShaky));
    let branches: Vec<_> = found.branches.iter().flatten().collect();
    let facts: Vec<_> = branches
        .iter()
        .map(|branch| (branch.dimension, branch.instantaneous))
        .collect();
    assert_eq!(facts, [(3, Some(6))]);
}
