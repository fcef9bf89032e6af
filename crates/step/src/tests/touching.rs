//! Contacts of parts that are written here, and the joints that they make.

#![allow(clippy::unwrap_used)]

use super::builder::{Order, Product, Text};
use crate::{Assembly, ContactKind, ContactOptions, PairOfParts, contacts, joint_of, read};

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

struct Machine {
    text: Text,
    whole: Product,
}

impl Machine {
    fn new() -> Self {
        let mut text = Text::new();
        let whole = text.product("whole", &[]);
        Self { text, whole }
    }

    fn place(&mut self, part: Product, at: [f64; 3], x: [f64; 3]) {
        let whole = self.whole;
        self.text
            .place("", whole, part, (at, Z, x), Order::default());
    }

    fn read(&self) -> (Assembly, Vec<PairOfParts>) {
        let text = self.text.finished();
        let assembly = read(text.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
        let pairs = contacts(&assembly, &ContactOptions::default());
        (assembly, pairs)
    }
}

/// Pairs of names with the class of their joint, and the clearances of cylindrical contacts (µm).
fn joints(assembly: &Assembly, pairs: &[PairOfParts]) -> Vec<String> {
    let words = |pair: &PairOfParts| {
        let name = |place: usize| assembly.parts[place].name.clone();
        let joint = joint_of(&pair.contacts, assembly.accuracy).unwrap();
        assert!(joint.margin.is_clear(), "{pair:?}");
        format!(
            "{} {} {}",
            name(pair.first),
            name(pair.second),
            joint.subgroup.short_name()
        )
    };
    pairs.iter().map(words).collect()
}

fn count(pairs: &[PairOfParts], kind: ContactKind) -> usize {
    let all = pairs.iter().flat_map(|pair| &pair.contacts);
    all.filter(|contact| contact.kind == kind).count()
}

#[test]
fn a_four_bar_of_bars_and_pins() {
    for halves in [false, true] {
        let mut machine = Machine::new();
        let mut bars = Vec::new();
        for (name, length) in [
            ("ground", 40.0),
            ("coupler", 40.0),
            ("crank", 20.0),
            ("rocker", 20.0),
        ] {
            let holes = [(0.0, 0.0, 2.05), (length, 0.0, 2.05)];
            let high = [length + 5.0, 5.0, 5.0];
            let faces = machine.text.block([-5.0, -5.0, 0.0], high, &holes, halves);
            bars.push(machine.text.product(name, &faces));
        }
        let pin = machine.text.pin(2.0, (0.0, 10.0));
        let pin = machine.text.product("pin", &pin);
        machine.place(bars[0], [0.0; 3], X);
        machine.place(bars[1], [0.0, 20.0, 0.0], X);
        machine.place(bars[2], [0.0, 0.0, 5.0], Y);
        machine.place(bars[3], [40.0, 0.0, 5.0], Y);
        for (x, y) in [(0.0, 0.0), (40.0, 0.0), (0.0, 20.0), (40.0, 20.0)] {
            machine.place(pin, [x, y, 0.0], X);
        }
        let (assembly, pairs) = machine.read();
        assert_eq!(count(&pairs, ContactKind::Cylindrical), 8);
        assert_eq!(count(&pairs, ContactKind::Planar), 4);
        assert_eq!(
            count(&pairs, ContactKind::Spherical) + count(&pairs, ContactKind::Conical),
            0
        );
        let mut found = joints(&assembly, &pairs);
        found.sort();
        assert_eq!(
            found,
            [
                "coupler crank G",
                "coupler pin (3) C",
                "coupler pin (4) C",
                "coupler rocker G",
                "crank pin (3) C",
                "crank pin C",
                "ground crank G",
                "ground pin (2) C",
                "ground pin C",
                "ground rocker G",
                "rocker pin (2) C",
                "rocker pin (4) C",
            ]
        );
        let room = pairs
            .iter()
            .flat_map(|pair| &pair.contacts)
            .filter(|contact| contact.kind == ContactKind::Cylindrical)
            .map(|contact| contact.clearance);
        for clearance in room {
            assert!((clearance - 5e-5).abs() < 1e-12, "{clearance}");
        }
    }
}

#[test]
fn a_pin_with_a_head_is_a_hinge() {
    let mut machine = Machine::new();
    let plate = machine.text.block(
        [-20.0, -20.0, 0.0],
        [20.0, 20.0, 6.0],
        &[(0.0, 0.0, 3.0)],
        false,
    );
    let plate = machine.text.product("plate", &plate);
    let bolt = machine.text.headed_pin(3.0, 6.0, (5.0, 2.0));
    let bolt = machine.text.product("bolt", &bolt);
    machine.place(plate, [0.0; 3], X);
    machine.place(bolt, [0.0, 0.0, 6.0], X);
    let (assembly, pairs) = machine.read();
    assert_eq!(joints(&assembly, &pairs), ["plate bolt R"]);
    let kinds: Vec<ContactKind> = pairs[0].contacts.iter().map(|c| c.kind).collect();
    assert_eq!(kinds.len(), 2, "{kinds:?}");
}

#[test]
fn a_block_in_a_corner_slides() {
    let mut machine = Machine::new();
    let floor = machine
        .text
        .block([0.0, 0.0, -5.0], [100.0, 100.0, 0.0], &[], false);
    let wall = machine
        .text
        .block([0.0, -5.0, 0.0], [100.0, 0.0, 20.0], &[], false);
    let corner = machine.text.product("corner", &[floor, wall].concat());
    let block = machine.text.block([0.0; 3], [10.0, 10.0, 10.0], &[], false);
    let block = machine.text.product("block", &block);
    machine.place(corner, [0.0; 3], X);
    machine.place(block, [30.0, 0.0, 0.0], X);
    // A tenth of a millimetre above the floor and away from the wall, and a millimetre away from both.
    machine.place(block, [60.0, 0.1, 0.1], X);
    machine.place(block, [80.0, 1.0, 1.0], X);
    let (assembly, pairs) = machine.read();
    assert_eq!(
        joints(&assembly, &pairs),
        ["corner block T", "corner block (2) T"]
    );
}

#[test]
fn parts_that_share_an_edge_do_not_touch() {
    let mut machine = Machine::new();
    let cube = machine.text.block([0.0; 3], [10.0, 10.0, 10.0], &[], false);
    let cube = machine.text.product("cube", &cube);
    machine.place(cube, [0.0; 3], X);
    machine.place(cube, [10.0, 0.0, 10.0], X);
    machine.place(cube, [0.0, 40.0, 0.0], X);
    machine.place(cube, [10.0, 40.0, 0.0], X);
    let (assembly, pairs) = machine.read();
    assert_eq!(joints(&assembly, &pairs), ["cube (3) cube (4) G"]);
}
