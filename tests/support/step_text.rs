//! STEP texts of small machines, made of blocks, holes and pins by the writer of the reader's own tests. Lengths are millimetres.

#[path = "../../crates/step/src/tests/builder.rs"]
#[allow(dead_code)] // the reader's tests need more of it
mod builder;
#[path = "../../crates/step/src/tests/solids.rs"]
#[allow(dead_code)]
mod solids;

use builder::{Order, Product, Text, list};

type Vector = [f64; 3];

/// Origin, z axis and x axis.
type At = (Vector, Vector, Vector);

const X: Vector = [1.0, 0.0, 0.0];
const Y: Vector = [0.0, 1.0, 0.0];
const Z: Vector = [0.0, 0.0, 1.0];
const HERE: Vector = [0.0; 3];

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

    fn block(
        &mut self,
        name: &str,
        low: Vector,
        high: Vector,
        holes: &[(f64, f64, f64)],
    ) -> Product {
        let faces = self.text.block(low, high, holes, false);
        self.text.product(name, &faces)
    }

    /// A part of several blocks, without holes but in the first.
    fn blocks(
        &mut self,
        name: &str,
        hole: &[(f64, f64, f64)],
        corners: &[(Vector, Vector)],
    ) -> Product {
        let mut faces = Vec::new();
        for (place, (low, high)) in corners.iter().enumerate() {
            let holes = if place == 0 { hole } else { &[] };
            faces.extend(self.text.block(*low, *high, holes, false));
        }
        self.text.product(name, &faces)
    }

    /// A part of several solids, each with its own place in it.
    fn combined(&mut self, name: &str, pieces: &[(Vec<u64>, At)]) -> Product {
        let context = self.text.context();
        let origin = self.text.placement(HERE, Z, X);
        let mut items = vec![origin];
        for (faces, (at, z, x)) in pieces {
            let own = self.text.placement(HERE, Z, X);
            let shell = format!("CLOSED_SHELL('',({}))", list(faces));
            let shell = self.text.add(&shell);
            let solid = self.text.add(&format!("MANIFOLD_SOLID_BREP('',#{shell})"));
            let shape = self.text.add(&format!(
                "ADVANCED_BREP_SHAPE_REPRESENTATION('',(#{own},#{solid}),#{context})"
            ));
            let map = self
                .text
                .add(&format!("REPRESENTATION_MAP(#{own},#{shape})"));
            let target = self.text.placement(*at, *z, *x);
            items.push(self.text.add(&format!("MAPPED_ITEM('',#{map},#{target})")));
        }
        let shape = self.text.add(&format!(
            "SHAPE_REPRESENTATION('',({}),#{context})",
            list(&items)
        ));
        self.text.shown_by(name, shape, origin)
    }

    fn place(&mut self, part: Product, at: Vector, x: Vector) {
        let whole = self.whole;
        self.text
            .place("", whole, part, (at, Z, x), Order::default());
    }
}

/// Four bars, two on each other two, and a pin in every corner: holes are wider than pins by `room` all around, and come as halves from
/// some programs.
pub fn four_bar(room: f64, halves: bool) -> String {
    let mut machine = Machine::new();
    let hole = 2.0 + room;
    let mut bars = Vec::new();
    for (name, length) in [
        ("ground", 40.0),
        ("coupler", 40.0),
        ("crank", 20.0),
        ("rocker", 20.0),
    ] {
        let holes = [(0.0, 0.0, hole), (length, 0.0, hole)];
        let high = [length + 5.0, 5.0, 5.0];
        let faces = machine.text.block([-5.0, -5.0, 0.0], high, &holes, halves);
        bars.push(machine.text.product(name, &faces));
    }
    let pin = machine.text.pin(2.0, (0.0, 10.0));
    let pin = machine.text.product("pin", &pin);
    machine.place(bars[0], HERE, X);
    machine.place(bars[1], [0.0, 20.0, 0.0], X);
    machine.place(bars[2], [0.0, 0.0, 5.0], Y);
    machine.place(bars[3], [40.0, 0.0, 5.0], Y);
    for (x, y) in [(0.0, 0.0), (40.0, 0.0), (0.0, 20.0), (40.0, 20.0)] {
        machine.place(pin, [x, y, 0.0], X);
    }
    machine.text.finished()
}

/// A crank of 30, a rod of 50, and a slider on a floor along a wall; three pins.
pub fn slider_crank(room: f64) -> String {
    let mut machine = Machine::new();
    let hole = 3.0 + room;
    let base = machine.blocks(
        "base",
        &[(0.0, 0.0, hole)],
        &[
            ([-20.0, -20.0, -5.0], [120.0, 20.0, 0.0]),
            ([20.0, -10.0, 0.0], [110.0, -6.0, 4.0]),
        ],
    );
    let ends = |length: f64| [(0.0, 0.0, hole), (length, 0.0, hole)];
    let crank = machine.block("crank", [-5.0, -5.0, 0.0], [35.0, 5.0, 5.0], &ends(30.0));
    let rod = machine.block("rod", [-5.0, -5.0, 0.0], [55.0, 5.0, 5.0], &ends(50.0));
    let slider = machine.block(
        "slider",
        [-8.0, -6.0, 0.0],
        [8.0, 6.0, 5.0],
        &[(0.0, 0.0, hole)],
    );
    let mut pins = Vec::new();
    for (name, heights) in [
        ("main pin", (-5.0, 5.0)),
        ("crank pin", (0.0, 10.0)),
        ("slider pin", (1.0, 10.0)),
    ] {
        let faces = machine.text.pin(3.0, heights);
        pins.push(machine.text.product(name, &faces));
    }
    machine.place(base, HERE, X);
    machine.place(crank, HERE, Y);
    machine.place(rod, [0.0, 30.0, 5.0], [0.8, -0.6, 0.0]);
    machine.place(slider, [40.0, 0.0, 0.0], X);
    machine.place(pins[0], HERE, X);
    machine.place(pins[1], [0.0, 30.0, 0.0], X);
    machine.place(pins[2], [40.0, 0.0, 0.0], X);
    machine.text.finished()
}

/// A spindle that hangs in a frame by its head, and a nut on it that two walls of the frame guide.
pub fn screw_jack(room: f64) -> String {
    let mut machine = Machine::new();
    let hole = 5.0 + room;
    let frame = machine.blocks(
        "frame",
        &[(0.0, 0.0, hole)],
        &[
            ([-40.0, -40.0, 0.0], [40.0, 40.0, 10.0]),
            ([10.0, -20.0, -80.0], [15.0, 20.0, 0.0]),
            ([-20.0, 10.0, -80.0], [10.0, 15.0, 0.0]),
        ],
    );
    let nut = machine.block(
        "nut",
        [-10.0, -10.0, -60.0],
        [10.0, 10.0, -40.0],
        &[(0.0, 0.0, hole)],
    );
    let spindle = machine.text.headed_pin(5.0, 100.0, (9.0, 6.0));
    let spindle = machine.text.product("lead screw", &spindle);
    machine.place(frame, HERE, X);
    machine.place(nut, HERE, X);
    machine.place(spindle, [0.0, 0.0, 10.0], X);
    machine.text.finished()
}

/// Two forks and a cross with shoulders between them, turned as a whole so that no axis is one of the file's where `tilted`.
pub fn universal_joint(room: f64, tilted: bool) -> String {
    let mut machine = Machine::new();
    let hole = [(0.0, 0.0, 3.0 + room)];
    let along_x = (HERE, X, Y);
    let along_y = (HERE, Y, Z);
    for (name, at) in [("base fork", along_x), ("output fork", along_y)] {
        let mut faces = Vec::new();
        for (low, high) in [(15.0, 20.0), (-20.0, -15.0)] {
            let ear = machine
                .text
                .block([-5.0, -5.0, low], [5.0, 5.0, high], &hole, false);
            faces.extend(ear);
        }
        let fork = machine.combined(name, &[(faces, at)]);
        put(&mut machine, fork, tilted);
    }
    let body = machine
        .text
        .block([-15.0, -15.0, -5.0], [15.0, 15.0, 5.0], &[], false);
    let one = machine.text.pin(3.0, (-20.0, 20.0));
    let other = machine.text.pin(3.0, (-20.0, 20.0));
    let pieces = [(body, (HERE, Z, X)), (one, along_x), (other, along_y)];
    let cross = machine.combined("cross", &pieces);
    put(&mut machine, cross, tilted);
    machine.text.finished()
}

/// Places a part at the origin, or beside it and turned about two axes.
fn put(machine: &mut Machine, part: Product, tilted: bool) {
    let whole = machine.whole;
    let at = match tilted {
        // The columns of a rotation by two angles whose sines are none of the well-known ones.
        true => {
            let (s, c) = 0.3_f64.sin_cos();
            let (t, d) = 0.7_f64.sin_cos();
            ([12.3, -4.56, 7.89], [s * d, s * t, c], [c * d, c * t, -s])
        }
        false => (HERE, Z, X),
    };
    machine.text.place("", whole, part, at, Order::default());
}

/// A saddle along a base, and a table across it.
pub fn cross_slide() -> String {
    let mut machine = Machine::new();
    let base = machine.blocks(
        "machine bed",
        &[],
        &[
            ([0.0, 0.0, -5.0], [100.0, 100.0, 0.0]),
            ([0.0, -5.0, 0.0], [100.0, 0.0, 20.0]),
        ],
    );
    let saddle = machine.blocks(
        "saddle",
        &[],
        &[
            (HERE, [30.0, 30.0, 10.0]),
            ([0.0, 0.0, 10.0], [5.0, 30.0, 20.0]),
        ],
    );
    let table = machine.block("table", HERE, [20.0, 20.0, 5.0], &[]);
    machine.place(base, HERE, X);
    machine.place(saddle, [30.0, 0.0, 0.0], X);
    machine.place(table, [35.0, 5.0, 10.0], X);
    machine.text.finished()
}

/// A plate, something of this name in its hole whose head rests on it, and a block of its own far away if `loose`.
pub fn plate_and(name: &str, loose: bool) -> String {
    let mut machine = Machine::new();
    let plate = machine.block(
        "plate",
        [-20.0, -20.0, 0.0],
        [20.0, 20.0, 6.0],
        &[(0.0, 0.0, 3.0)],
    );
    let headed = machine.text.headed_pin(3.0, 6.0, (5.0, 2.0));
    let headed = machine.text.product(name, &headed);
    machine.place(plate, HERE, X);
    machine.place(headed, [0.0, 0.0, 6.0], X);
    if loose {
        let block = machine.block("stone", HERE, [5.0, 5.0, 5.0], &[]);
        machine.place(block, [200.0, 0.0, 0.0], X);
    }
    machine.text.finished()
}

/// A plate on a base, a headed part of one name through both, and a block on its end, of another, that sits against the base.
pub fn two_plates(bolt: &str, nut: &str) -> String {
    let mut machine = Machine::new();
    let hole = [(0.0, 0.0, 3.0)];
    let (low, high) = ([-20.0, -20.0, 0.0], [20.0, 20.0, 6.0]);
    let base = machine.block("base", low, high, &hole);
    let plate = machine.block("plate", low, [20.0, 10.0, 6.0], &hole);
    let headed = machine.text.headed_pin(3.0, 18.0, (6.0, 2.0));
    let headed = machine.text.product(bolt, &headed);
    let block = machine.block(nut, [-5.0, -5.0, 0.0], [5.0, 5.0, 5.0], &hole);
    machine.place(base, [0.0, 0.0, -6.0], X);
    machine.place(plate, HERE, X);
    machine.place(headed, [0.0, 0.0, 6.0], X);
    machine.place(block, [0.0, 0.0, -11.0], X);
    machine.text.finished()
}
