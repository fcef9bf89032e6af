//! What is read from well-formed files.

#![allow(clippy::unwrap_used)]

use super::builder::{Order, Product, Text, Unit, list};
use crate::{Assembly, Face, NoteKind, Side, Surface, read};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

fn assembly(text: &Text) -> Assembly {
    read(text.finished().as_bytes()).unwrap_or_else(|error| panic!("{error}\n{}", text.finished()))
}

fn near(found: Vector3<f64>, expected: [f64; 3]) {
    let expected = Vector3::from(expected);
    assert!(
        (found - expected).norm() < 1e-12,
        "{found} is not {expected}"
    );
}

fn cylinders(faces: &[Face]) -> Vec<&Face> {
    let round = |face: &&Face| matches!(face.surface, Surface::Cylinder { .. });
    faces.iter().filter(round).collect()
}

/// A plate with a hole, and a pin in it.
fn plate_and_pin(text: &mut Text, order: Order) -> Product {
    let plate = text.block([0.0; 3], [40.0, 20.0, 5.0], &[(10.0, 10.0, 3.0)], false);
    let plate = text.product("plate", &plate);
    let pin = text.pin(3.0, (0.0, 12.0));
    let pin = text.product("pin", &pin);
    let whole = text.product("whole", &[]);
    text.place("plate:1", whole, plate, ([1.0, 2.0, 3.0], Z, X), order);
    text.place("pin:1", whole, pin, ([11.0, 12.0, 0.0], Z, Y), order);
    whole
}

#[test]
fn a_plate_with_a_hole_and_a_pin() {
    for unit in [Unit::Millimetre, Unit::Metre, Unit::Inch] {
        let mut text = Text::in_units(unit, false);
        plate_and_pin(&mut text, Order::default());
        let assembly = assembly(&text);
        let expected = match unit {
            Unit::Millimetre => 0.001,
            Unit::Metre => 1.0,
            Unit::Inch => 0.0254,
        };
        assert_eq!(assembly.length_unit, expected);
        assert!((assembly.accuracy - 1e-9).abs() < 1e-20);
        assert!(assembly.notes.is_empty(), "{:?}", assembly.notes);
        let [plate, pin] = assembly.parts.as_slice() else {
            panic!("{:?}", assembly.parts);
        };
        assert_eq!((plate.name.as_str(), pin.name.as_str()), ("plate", "pin"));
        assert_eq!(pin.path, ["pin:1"]);
        near(plate.pose.translation, [0.001, 0.002, 0.003]);
        near(pin.pose.translation, [0.011, 0.012, 0.0]);
        // x of the pin along y of the assembly.
        near(pin.pose.rotation * Vector3::x(), Y);
        assert_eq!((plate.faces.len(), pin.faces.len()), (7, 3));
        let [hole] = cylinders(&plate.faces)[..] else {
            panic!("one hole");
        };
        let [shaft] = cylinders(&pin.faces)[..] else {
            panic!("one shaft");
        };
        assert_eq!(
            (hole.material, shaft.material),
            (Side::Outside, Side::Inside)
        );
        assert_eq!((hole.turned, shaft.turned), (TAU, TAU));
        assert!((hole.extent.1 - 0.005).abs() < 1e-12 && hole.extent.0.abs() < 1e-12);
        let Surface::Cylinder { point, radius, .. } = hole.surface else {
            panic!("a cylinder");
        };
        near(point, [0.01, 0.01, 0.0]);
        assert!((radius - 0.003).abs() < 1e-12);
        // Normals of planes point out of the material: away from the middle.
        let middle = Vector3::new(0.02, 0.01, 0.0025);
        let flats = plate.faces.iter().filter_map(|face| match face.surface {
            Surface::Plane { point, normal } => Some((point - middle).dot(&normal)),
            _ => None,
        });
        let heights: Vec<f64> = flats.collect();
        assert!(
            heights.len() == 6 && heights.iter().all(|h| *h > 0.0),
            "{heights:?}"
        );
    }
}

#[test]
fn the_order_of_items_and_representations_says_nothing() {
    let mut poses = Vec::new();
    for items_exchanged in [false, true] {
        for representations_exchanged in [false, true] {
            let mut text = Text::new();
            let order = Order {
                items_exchanged,
                representations_exchanged,
            };
            plate_and_pin(&mut text, order);
            let assembly = assembly(&text);
            poses.push(
                assembly
                    .parts
                    .iter()
                    .map(|part| part.pose)
                    .collect::<Vec<_>>(),
            );
        }
    }
    near(poses[0][1].translation, [0.011, 0.012, 0.0]);
    for other in &poses[1..] {
        for (a, b) in poses[0].iter().zip(other) {
            assert!((a.translation - b.translation).norm() < 1e-15);
            assert!((a.rotation - b.rotation).norm() < 1e-15);
        }
    }
}

#[test]
fn occurrences_are_nested_and_names_unique() {
    let mut text = Text::new();
    let pin = text.pin(2.0, (0.0, 5.0));
    let pin = text.product("pin", &pin);
    let pair = text.product("pair", &[]);
    let whole = text.product("whole", &[]);
    let order = Order::default();
    text.place("left", pair, pin, ([0.0; 3], Z, X), order);
    text.place("right", pair, pin, ([10.0, 0.0, 0.0], Z, X), order);
    text.place("near", whole, pair, ([0.0; 3], Z, X), order);
    text.place("far", whole, pair, ([0.0, 100.0, 0.0], X, Y), order);
    let assembly = assembly(&text);
    let names: Vec<&str> = assembly.parts.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["pin", "pin (2)", "pin (3)", "pin (4)"]);
    let paths: Vec<String> = assembly.parts.iter().map(|p| p.path.join("/")).collect();
    assert_eq!(paths, ["near/left", "near/right", "far/left", "far/right"]);
    // z along x, x along y: what was 10 mm along x is 10 mm along y.
    let last = &assembly.parts[3].pose;
    near(last.translation, [0.0, 0.11, 0.0]);
    let columns = [Vector3::y(), Vector3::z(), Vector3::x()];
    assert!((last.rotation - Matrix3::from_columns(&columns)).norm() < 1e-15);
}

#[test]
fn mapped_items_place_components() {
    let mut text = Text::new();
    let pin = text.pin(2.0, (0.0, 5.0));
    let pin = text.product("pin", &pin);
    let whole = text.product("whole", &[]);
    text.place_mapped("a", whole, pin, [1.0, 0.0, 0.0]);
    text.place_mapped("b", whole, pin, [0.0, 2.0, 0.0]);
    let assembly = assembly(&text);
    let mut places: Vec<_> = assembly.parts.iter().map(|p| p.pose.translation).collect();
    // The items of a representation are a set: which occurrence has which place is nowhere said.
    places.sort_by(|a, b| a.x.total_cmp(&b.x));
    assert_eq!(places.len(), 2);
    near(places[0], [0.0, 0.002, 0.0]);
    near(places[1], [0.001, 0.0, 0.0]);
}

#[test]
fn contexts_have_their_own_units() {
    let mut text = Text::in_units(Unit::Inch, false);
    let pin = text.pin(25.4, (0.0, 50.8));
    let pin = text.product("pin", &pin);
    text.use_context(Unit::Metre, false);
    let whole = text.product("whole", &[]);
    text.place(
        "pin",
        whole,
        pin,
        ([2000.0, 0.0, 0.0], Z, X),
        Order::default(),
    );
    let assembly = assembly(&text);
    near(assembly.parts[0].pose.translation, [2.0, 0.0, 0.0]);
    let [shaft] = cylinders(&assembly.parts[0].faces)[..] else {
        panic!("one shaft");
    };
    let Surface::Cylinder { radius, .. } = shaft.surface else {
        panic!("a cylinder");
    };
    assert_eq!(radius, 0.0254);
}

#[test]
fn halves_are_one_hole() {
    let mut text = Text::new();
    let holes = [(10.0, 10.0, 3.0), (30.0, 10.0, 3.0)];
    let plate = text.block([0.0; 3], [40.0, 20.0, 5.0], &holes, true);
    text.product("plate", &plate);
    let assembly = assembly(&text);
    let found = cylinders(&assembly.parts[0].faces);
    assert_eq!(found.len(), 2);
    for hole in found {
        assert_eq!((hole.halves.len(), hole.material), (1, Side::Outside));
        assert!((hole.turned - TAU).abs() < 1e-9, "{}", hole.turned);
    }
}

#[test]
fn angles_have_their_units_and_other_surfaces_their_names() {
    let mut text = Text::in_units(Unit::Millimetre, true);
    let frame = text.placement([0.0, 0.0, 10.0], Z, X);
    let bound = text.tube_bound((0.0, 0.0, 5.0), (10.0, 11.0), (0.0, TAU));
    let cone = text.add(&format!("CONICAL_SURFACE('',#{frame},5.,45.)"));
    let cone = text.face(&[bound], cone, true);
    let ring = text.add(&format!("TOROIDAL_SURFACE('',#{frame},10.,2.)"));
    let ring = text.face(&[bound], ring, true);
    let ball = text.add(&format!("SPHERICAL_SURFACE('',#{frame},5.)"));
    let socket = text.face(&[bound], ball, false);
    text.product("part", &[cone, ring, socket]);
    let assembly = assembly(&text);
    let [cone, ring, socket] = assembly.parts[0].faces.as_slice() else {
        panic!("three faces");
    };
    let Surface::Cone {
        apex, half_angle, ..
    } = cone.surface
    else {
        panic!("{cone:?}");
    };
    assert!((half_angle - PI / 4.0).abs() < 1e-15);
    near(apex, [0.0, 0.0, 0.005]);
    assert!((cone.extent.0 - 0.005).abs() < 1e-12);
    assert_eq!(ring.surface, Surface::Other("TOROIDAL_SURFACE".to_owned()));
    assert_eq!(assembly.notes.len(), 1);
    assert!(assembly.notes[0].kind == NoteKind::MayTouch);
    assert_eq!(socket.material, Side::Outside);
}

/// A quarter of a cylinder of radius 5 about z, 8 high, as a rational B-spline of degree 2 by 1, with knots as these.
fn quarter(text: &mut Text, knots: &str) -> u64 {
    let corners = [[5.0, 0.0], [5.0, 5.0], [0.0, 5.0]];
    let rows: Vec<String> = corners
        .iter()
        .map(|[x, y]| {
            let row = [text.point([*x, *y, 0.0]), text.point([*x, *y, 8.0])];
            format!("({})", list(&row))
        })
        .collect();
    let poles = rows.join(",");
    let w = 0.5_f64.sqrt();
    text.add(&format!(
        "(BOUNDED_SURFACE()B_SPLINE_SURFACE(2,1,({poles}),.UNSPECIFIED.,.F.,.F.,.F.)\
         {knots}GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE(((1.,1.),({w},{w}),(1.,1.)))\
         REPRESENTATION_ITEM('')SURFACE())"
    ))
}

#[test]
fn rational_splines_are_what_they_are() {
    for knots in [
        "B_SPLINE_SURFACE_WITH_KNOTS((3,3),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.)",
        "BEZIER_SURFACE()",
        "QUASI_UNIFORM_SURFACE()",
    ] {
        a_quarter_of_a_cylinder_is_one(knots);
    }
}

fn a_quarter_of_a_cylinder_is_one(knots: &str) {
    let mut text = Text::new();
    let surface = quarter(&mut text, knots);
    let bound = text.tube_bound((0.0, 0.0, 5.0), (0.0, 8.0), (0.0, PI / 2.0));
    // Along the arc times up is away from the axis.
    let faces = [
        text.face(&[bound], surface, true),
        text.face(&[bound], surface, false),
    ];
    text.product("part", &faces);
    let assembly = assembly(&text);
    assert!(assembly.notes.is_empty(), "{:?}", assembly.notes);
    let [pin, hole] = assembly.parts[0].faces.as_slice() else {
        panic!("two faces");
    };
    assert_eq!((pin.material, hole.material), (Side::Inside, Side::Outside));
    let Surface::Cylinder {
        point,
        direction,
        radius,
    } = pin.surface
    else {
        panic!("{pin:?}");
    };
    assert!((radius - 0.005).abs() < 1e-9);
    assert!(direction.cross(&Vector3::z()).norm() < 1e-7);
    assert!(point.cross(&direction).norm() < 1e-8);
    assert!((pin.turned - PI / 2.0).abs() < 1e-6, "{}", pin.turned);
}

/// A square of 4 by 4 with its corners as the control points of a surface, and one edge as a curve: as I-DEAS writes what is flat.
#[test]
fn flat_surfaces_without_written_knots_are_planes() {
    let mut text = Text::new();
    let [a, b, c, d] =
        [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [4.0, 4.0]].map(|[x, y]| text.point([x, y, 7.0]));
    let surface = text.add(&format!(
        "QUASI_UNIFORM_SURFACE('',1,1,((#{a},#{c}),(#{b},#{d})),.PLANE_SURF.,.F.,.F.,.U.)"
    ));
    let ends = [a, b, d, c].map(|point| text.add(&format!("VERTEX_POINT('',#{point})")));
    let sides = [(a, b, 0, 1), (b, d, 1, 2), (d, c, 2, 3), (c, a, 3, 0)];
    let edges = sides.map(|(from, to, first, second)| {
        let curve = text.add(&format!(
            "QUASI_UNIFORM_CURVE('',1,(#{from},#{to}),.POLYLINE_FORM.,.F.,.U.)"
        ));
        let (first, second) = (ends[first], ends[second]);
        let edge = text.add(&format!("EDGE_CURVE('',#{first},#{second},#{curve},.T.)"));
        text.add(&format!("ORIENTED_EDGE('',*,*,#{edge},.T.)"))
    });
    let ring = text.add(&format!("EDGE_LOOP('',({}))", list(&edges)));
    let bound = text.add(&format!("FACE_BOUND('',#{ring},.T.)"));
    let face = text.face(&[bound], surface, true);
    text.product("part", &[face]);
    let assembly = assembly(&text);
    assert!(assembly.notes.is_empty(), "{:?}", assembly.notes);
    let Surface::Plane { point, normal } = assembly.parts[0].faces[0].surface else {
        panic!("{:?}", assembly.parts[0].faces);
    };
    near(normal, Z);
    assert!((point.z - 0.007).abs() < 1e-15);
}

#[test]
fn voids_point_into_themselves() {
    let mut text = Text::new();
    let outer = text.pin(10.0, (0.0, 20.0));
    let inner = text.pin(2.0, (5.0, 10.0));
    let outer = text.add(&format!("CLOSED_SHELL('',({}))", list(&outer)));
    let inner = text.add(&format!("CLOSED_SHELL('',({}))", list(&inner)));
    let inner = text.add(&format!("ORIENTED_CLOSED_SHELL('',*,#{inner},.F.)"));
    let solid = text.add(&format!("BREP_WITH_VOIDS('',#{outer},(#{inner}))"));
    let frame = text.placement([0.0; 3], Z, X);
    let context = text.context();
    let shown = text.add(&format!(
        "ADVANCED_BREP_SHAPE_REPRESENTATION('',(#{frame},#{solid}),#{context})"
    ));
    // The shape is the product's by way of a second representation.
    let own = text.add(&format!("SHAPE_REPRESENTATION('',(#{frame}),#{context})"));
    text.add(&format!(
        "SHAPE_REPRESENTATION_RELATIONSHIP('','',#{own},#{shown})"
    ));
    text.shown_by(r"H\X2\00FC\X0\lse", own, frame);
    let assembly = assembly(&text);
    assert_eq!(assembly.parts[0].name, "Hülse");
    let sides: Vec<Side> = cylinders(&assembly.parts[0].faces)
        .iter()
        .map(|face| face.material)
        .collect();
    assert_eq!(sides, [Side::Inside, Side::Outside]);
}

#[test]
fn what_is_not_read_is_said() {
    let mut text = Text::new();
    let pin = text.pin(1.0, (0.0, 1.0));
    let pin = text.product("pin", &pin);
    let empty = text.product("elsewhere", &[]);
    let whole = text.product("whole", &[]);
    text.place("", whole, pin, ([0.0; 3], Z, X), Order::default());
    text.place("", whole, empty, ([0.0; 3], Z, X), Order::default());
    let frame = text.placement([0.0; 3], Z, X);
    let pair = format!("REVOLUTE_PAIR('','','',#{frame},#{frame},$,*,*,*,*,*,*)");
    let pair = text.add(&pair);
    let assembly = assembly(&text);
    assert_eq!(assembly.parts.len(), 1);
    let found: Vec<(NoteKind, u64)> = assembly.notes.iter().map(|n| (n.kind, n.entity)).collect();
    let expected = [
        (NoteKind::MayTouch, empty.definition),
        (NoteKind::MayJoin, pair),
    ];
    assert_eq!(found, expected);
}

/// As CATIA, NX and Creo write an assembly whose parts are files of their own.
#[test]
fn shapes_in_other_files_are_told() {
    let mut text = Text::new();
    let names = ["HEAD.stp", "tail.STEP", "drawing.pdf"];
    let mut first = 0;
    for name in names.iter().rev() {
        let kind = text.add("DOCUMENT_TYPE('')");
        first = text.add(&format!("DOCUMENT_FILE('{name}','','',#{kind},'','')"));
    }
    text.product("whole", &[]);
    let error = read(text.finished().as_bytes()).unwrap_err();
    // Those of shapes, in the order of the file.
    let told =
        "found shapes that stand in 2 other files, `tail.STEP`, `HEAD.stp`, which are not read";
    assert!(error.to_string().contains(told), "{error}");
    assert_eq!(error.entity, Some(first - 2));
    let pin = text.pin(1.0, (0.0, 1.0));
    text.product("pin", &pin);
    let notes = assembly(&text).notes;
    let of_files = notes.iter().filter(|note| note.entity == first - 2);
    assert_eq!(of_files.count(), 1, "{notes:?}");
}
