//! MJCF: masses and shapes, against closed forms.

use kutzbach::format::{Reading, read};
use kutzbach::mechanism::{Geometry, Inertial, Link, Mechanism};
use std::f64::consts::PI;

fn model(inside: &str) -> Reading {
    let text = format!("<mujoco>{inside}</mujoco>");
    read(&text, "model.xml", &[]).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn link<'m>(mechanism: &'m Mechanism, name: &str) -> &'m Link {
    mechanism.link(mechanism.link_named(name).unwrap())
}

/// The only body of a model, with these elements in it.
fn body(inside: &str) -> Option<Inertial> {
    let text = format!("<worldbody><body name='b'><joint name='j'/>{inside}</body></worldbody>");
    link(&model(&text).mechanism, "b").inertial.clone()
}

/// Mass, centre, and `xx xy xz yy yz zz` along the axes of the origin.
fn numbers(inertial: &Inertial) -> (f64, [f64; 3], [f64; 6]) {
    (
        inertial.mass.value(),
        inertial.origin.position.each_ref().map(|x| x.value()),
        inertial.inertia.each_ref().map(|x| x.value()),
    )
}

fn is_near(found: &Inertial, mass: f64, centre: [f64; 3], inertia: [f64; 6]) {
    let (own, at, moments) = numbers(found);
    let near = |a: f64, b: f64, size: f64| (a - b).abs() <= 1e-12 * size;
    let largest = inertia.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!(near(own, mass, mass), "{own} {mass}");
    for (a, b) in at.into_iter().zip(centre) {
        assert!(near(a, b, 1.0), "{at:?} {centre:?}");
    }
    for (a, b) in moments.into_iter().zip(inertia) {
        assert!(near(a, b, largest), "{moments:?} {inertia:?}");
    }
}

#[test]
fn solids_weigh_what_their_formulas_say() {
    let diagonal = |mass: f64, [x, y, z]: [f64; 3]| [x, 0.0, 0.0, y, 0.0, z].map(|m| m * mass);
    let (r, h) = (0.1_f64, 0.25_f64);
    let box_mass = 1000.0 * 8.0 * 0.1 * 0.2 * 0.3;
    let ball = 1000.0 * 4.0 / 3.0 * PI * r.powi(3);
    let rod = 1000.0 * PI * r * r * 2.0 * h;
    let rod_across = (3.0 * r * r + 4.0 * h * h) / 12.0;
    // A ball in halves: about its own centre 2/5 r², halves moved apart by h.
    let ends_across = 0.4 * r * r + h * h + 0.75 * h * r;
    let capsule = ball + rod;
    for (geom, mass, moments) in [
        ("<geom size='0.1'/>", ball, [0.4 * r * r; 3]),
        (
            "<geom size='0.1' density='500'/>",
            ball / 2.0,
            [0.4 * r * r; 3],
        ),
        (
            "<geom size='0.1' density='500' mass='3'/>",
            3.0,
            [0.4 * r * r; 3],
        ),
        (
            "<geom type='box' size='0.1 0.2 0.3'/>",
            box_mass,
            [0.13 / 3.0, 0.1 / 3.0, 0.05 / 3.0],
        ),
        (
            "<geom type='ellipsoid' size='0.1 0.2 0.3'/>",
            box_mass * PI / 6.0,
            [0.13 / 5.0, 0.1 / 5.0, 0.05 / 5.0],
        ),
        (
            "<geom type='cylinder' size='0.1 0.25'/>",
            rod,
            [rod_across, rod_across, r * r / 2.0],
        ),
        (
            "<geom type='capsule' size='0.1 0.25'/>",
            capsule,
            [
                (rod * rod_across + ball * ends_across) / capsule,
                (rod * rod_across + ball * ends_across) / capsule,
                (rod * r * r / 2.0 + ball * 0.4 * r * r) / capsule,
            ],
        ),
    ] {
        let found = body(geom).unwrap();
        is_near(&found, mass, [0.0; 3], diagonal(mass, moments));
    }
}

#[test]
fn parts_weigh_what_the_whole_does() {
    let whole = body("<geom type='box' size='1 0.5 0.25' pos='1 2 3'/>").unwrap();
    let (mass, centre, inertia) = numbers(&whole);
    // Two halves, one of them turned by half a turn; and the same in a frame.
    for halves in [
        "<geom type='box' size='0.5 0.5 0.25' pos='0.5 2 3'/><geom type='box' size='0.5 0.5 0.25' pos='1.5 2 3' euler='0 0 180'/>",
        "<frame pos='1 2 3'><geom type='box' size='0.5 0.5 0.25' pos='0.5 0 0'/><geom type='box' size='0.5 0.5 0.25' pos='-0.5 0 0'/></frame>",
        "<geom type='box' size='0.5 0.5 0.25' pos='0.5 2 3'/><geom type='box' size='0.5 0.5 0.25' pos='1.5 2 3'/><geom size='1' mass='0'/><geom type='plane' size='1 1 1'/>",
    ] {
        is_near(&body(halves).unwrap(), mass, centre, inertia);
    }
    // A quarter turn about z exchanges x and y.
    let turned = body("<geom type='box' size='0.5 1 0.25' pos='1 2 3' euler='0 0 90'/>").unwrap();
    is_near(&turned, mass, centre, inertia);
}

#[test]
fn a_solid_from_one_point_to_another_lies_between_them() {
    let straight = body("<geom type='capsule' size='0.1 2.5'/>").unwrap();
    let (mass, _, [across, .., along]) = numbers(&straight);
    let found = body("<geom type='capsule' size='0.1' fromto='0 0 1 3 4 1'/>").unwrap();
    let (x, y) = (0.6, 0.8);
    let less = along - across;
    let inertia = [
        across + less * x * x,
        less * x * y,
        0.0,
        across + less * y * y,
        0.0,
        across,
    ];
    is_near(&found, mass, [1.5, 2.0, 1.0], inertia);
    // Boxes have both widths from the first size.
    let beam = body("<geom type='box' size='0.1' fromto='0 0 0 0 0 1'/>").unwrap();
    let same = body("<geom type='box' size='0.1 0.1 0.5' pos='0 0 0.5'/>").unwrap();
    let (mass, centre, inertia) = numbers(&same);
    is_near(&beam, mass, centre, inertia);
}

#[test]
fn inertials_come_before_geoms_unless_the_compiler_says_otherwise() {
    let own = "<inertial pos='1 2 3' mass='2' fullinertia='1 2 3 0.1 0.2 0.3'/><geom size='0.1'/>";
    let found = body(own).unwrap();
    is_near(&found, 2.0, [1.0, 2.0, 3.0], [1.0, 0.1, 0.2, 2.0, 0.3, 3.0]);
    assert_eq!(found.mass.literal_text(), Some("2"));
    let diagonal =
        body("<inertial pos='0 0 0' mass='2' diaginertia='1 2 3' euler='0 0 90'/>").unwrap();
    is_near(&diagonal, 2.0, [0.0; 3], [1.0, 0.0, 0.0, 2.0, 0.0, 3.0]);
    assert!((diagonal.origin.roll_pitch_yaw[2].value() - PI / 2.0).abs() < 1e-15);
    let with = |says: &str| {
        let text = format!(
            "<compiler inertiafromgeom='{says}'/><worldbody><body name='a'>{own}</body><body name='b'><geom size='0.1'/></body></worldbody>"
        );
        let mechanism = model(&text).mechanism;
        ["a", "b"].map(|name| {
            let inertial = link(&mechanism, name).inertial.as_ref();
            inertial.map(|inertial| inertial.mass.value())
        })
    };
    let ball = 1000.0 * 4.0 / 3.0 * PI * 1e-3;
    let near = |found: Option<f64>, mass: f64| (found.unwrap() - mass).abs() < 1e-12;
    assert_eq!(with("false"), [Some(2.0), None]);
    let [a, b] = with("auto");
    assert!(near(a, 2.0) && near(b, ball));
    let [a, b] = with("true");
    assert!(near(a, ball) && near(b, ball));
}

#[test]
fn the_last_link_of_a_body_bears_what_is_in_it_and_the_ground_its_shapes() {
    let reading = model(
        "<default><geom type='box' size='0.1 0.2 0.3'/></default><worldbody><geom type='plane' size='1 1 1'/><geom name='step'/>
         <body name='b'><joint name='x' type='slide'/><joint name='y'/><geom name='g' size='0.5' group='3'/>
         <geom type='sphere' contype='0' conaffinity='0'/></body></worldbody>",
    );
    let mechanism = &reading.mechanism;
    let first = link(mechanism, "b_1");
    assert!(first.inertial.is_none() && first.visuals.is_empty());
    let last = link(mechanism, "b");
    assert!(last.inertial.is_some());
    assert_eq!((last.collisions.len(), last.visuals.len()), (1, 1));
    assert_eq!(last.collisions[0].name.as_deref(), Some("g"));
    // What an element leaves out of `size` it has from its class.
    let Geometry::Box(size) = &last.collisions[0].geometry else {
        panic!("{:?}", last.collisions[0]);
    };
    assert_eq!(size.each_ref().map(|x| x.value()), [1.0, 0.4, 0.6]);
    let ground = link(mechanism, "world");
    assert!(ground.inertial.is_none());
    assert_eq!(ground.visuals[0].name.as_deref(), Some("step"));
    let skipped: Vec<&str> = reading.skipped.iter().map(|skip| &skip.what[..]).collect();
    assert_eq!(skipped, ["shape of <geom type=\"plane\">"]);
}

#[test]
fn what_is_not_known_of_masses_is_told() {
    let reading = model(
        "<compiler balanceinertia='true'/><worldbody><body name='b'><joint/><geom size='0.1'/><geom type='mesh' mesh='m'/></body>
         <body name='c'><geom type='mesh' mesh='m' mass='0'/><geom size='0.1'/></body>
         <body name='d'><geom size='-1'/><inertial mass='-1' pos='0 0 0'/></body></worldbody>",
    );
    assert!(link(&reading.mechanism, "b").inertial.is_none());
    assert!(link(&reading.mechanism, "c").inertial.is_some());
    assert!(link(&reading.mechanism, "d").inertial.is_none());
    let skipped: Vec<&str> = reading.skipped.iter().map(|skip| &skip.what[..]).collect();
    assert_eq!(
        skipped,
        [
            "`balanceinertia` of <compiler>",
            "mass of a body that depends on a mesh or a shell",
            "shape of <geom type=\"mesh\">",
            "<geom>: a sphere needs sizes above zero",
            "<inertial>: the mass is negative",
        ]
    );
}
