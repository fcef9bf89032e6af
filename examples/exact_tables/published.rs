//! The tables of Ruiz (1994) that state the size and the cost of a computation, and which of our files and settings belong to
//! every row.

/// Variables, equations, polynomials of the basis, seconds. A missing basis and time stand for a computation that did not end.
pub type Published = (usize, usize, Option<(usize, f64)>);

/// How a group of rows is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// All equations at once.
    Brute,
    /// Cycle by cycle, then together.
    Divide,
    /// What a cycle determines goes into the next ones.
    Instancing,
}

/// One computation: one row, or one row for every cycle and one for the rest.
pub struct Computation {
    pub example: &'static str,
    pub positional: bool,
    pub file: &'static str,
    pub way: Way,
    /// What the source states: the name of the row, and its figures.
    pub rows: &'static [(&'static str, Published)],
}

/// A table of the source.
pub struct Table {
    pub number: &'static str,
    pub title: &'static str,
    pub computations: &'static [Computation],
}

const PEGS: &str = "tests/thesis/double_peg.urdf";
const BODIES: &str = "tests/thesis/three_bodies.urdf";
const BLOCK: &str = "tests/thesis/block_and_corner.urdf";
const JAWS: &str = "tests/thesis/thomas_torras_offset.urdf";
const CARTESIAN: &str = "tests/thesis/cartesian_table.urdf";

const fn whole(
    example: &'static str,
    positional: bool,
    file: &'static str,
    rows: &'static [(&'static str, Published)],
) -> Computation {
    Computation {
        example,
        positional,
        file,
        way: Way::Brute,
        rows,
    }
}

const fn divided(
    example: &'static str,
    positional: bool,
    file: &'static str,
    rows: &'static [(&'static str, Published)],
) -> Computation {
    Computation {
        example,
        positional,
        file,
        way: Way::Divide,
        rows,
    }
}

/// Rows of these names are about everything.
pub const ALL: &str = "all equations";
pub const TOGETHER: &str = "together";

pub const TABLES: &[Table] = &[
    Table {
        number: "4.4",
        title: "positional and canonical variables",
        computations: &[
            whole(
                "double peg",
                true,
                PEGS,
                &[(ALL, (12, 20, Some((16, 1.53))))],
            ),
            whole(
                "double peg",
                false,
                PEGS,
                &[(ALL, (6, 14, Some((6, 0.25))))],
            ),
            whole(
                "three bodies",
                true,
                BODIES,
                &[(ALL, (20, 30, Some((24, 6.08))))],
            ),
            whole(
                "three bodies",
                false,
                BODIES,
                &[(ALL, (9, 15, Some((7, 0.51))))],
            ),
        ],
    },
    Table {
        number: "6.4",
        title: "double peg and hole",
        computations: &[
            whole(
                "double peg",
                true,
                PEGS,
                &[(ALL, (12, 20, Some((16, 1.53))))],
            ),
            whole(
                "double peg",
                false,
                PEGS,
                &[(ALL, (6, 14, Some((6, 0.25))))],
            ),
        ],
    },
    Table {
        number: "6.7",
        title: "block and corner",
        computations: &[
            whole("block", true, BLOCK, &[(ALL, (12, 18, Some((12, 2.334))))]),
            divided(
                "block",
                true,
                BLOCK,
                &[
                    ("C1 – C2", (12, 15, Some((10, 2.10)))),
                    ("C2 – C3", (12, 14, Some((11, 2.25)))),
                    ("C2 – C4", (12, 13, Some((11, 1.916)))),
                    (TOGETHER, (12, 32, Some((12, 1.983)))),
                ],
            ),
            whole(
                "block",
                false,
                BLOCK,
                &[(ALL, (24, 47, Some((23, 22.783))))],
            ),
            divided(
                "block",
                false,
                BLOCK,
                &[
                    ("C1 – C2", (10, 16, Some((7, 2.850)))),
                    ("C2 – C3", (9, 15, Some((8, 1.083)))),
                    ("C2 – C4", (11, 16, Some((10, 6.150)))),
                    (TOGETHER, (24, 25, Some((23, 6.916)))),
                ],
            ),
        ],
    },
    Table {
        number: "6.10",
        title: "assembly of Thomas and Torras",
        computations: &[
            whole("jaws", true, JAWS, &[(ALL, (36, 54, Some((37, 403.3))))]),
            divided(
                "jaws",
                true,
                JAWS,
                &[
                    ("C1 – C5 – C6", (24, 30, Some((25, 117.0)))),
                    ("C2 – C4 – C6", (24, 30, Some((25, 117.1)))),
                    ("C2 – C3 – C5 – C6", (36, 16, None)),
                    (TOGETHER, (36, 56, Some((37, 20.400)))),
                ],
            ),
            whole("jaws", false, JAWS, &[(ALL, (18, 42, Some((16, 5.800))))]),
            divided(
                "jaws",
                false,
                JAWS,
                &[
                    ("C1 – C5 – C6", (9, 15, Some((7, 1.400)))),
                    ("C2 – C4 – C6", (9, 15, Some((7, 1.600)))),
                    ("C2 – C3 – C5 – C6", (12, 16, Some((12, 4.817)))),
                    (TOGETHER, (18, 26, Some((16, 3.233)))),
                ],
            ),
        ],
    },
    Table {
        number: "6.13",
        title: "Cartesian table, divide and conquer",
        computations: &[
            whole("table", true, CARTESIAN, &[(ALL, (48, 58, None))]),
            whole(
                "table",
                false,
                CARTESIAN,
                &[(ALL, (40, 73, Some((40, 107.416))))],
            ),
            divided(
                "table",
                false,
                CARTESIAN,
                &[
                    ("C1 – C2", (12, 16, Some((9, 1.883)))),
                    ("C3 – C4", (12, 16, Some((9, 2.050)))),
                    ("C5 – C8", (6, 14, Some((6, 0.617)))),
                    ("C6 – C9", (6, 14, Some((6, 1.034)))),
                    (TOGETHER, (40, 43, Some((40, 54.333)))),
                ],
            ),
        ],
    },
    Table {
        number: "6.15",
        title: "Cartesian table, incremental instancing",
        computations: &[Computation {
            example: "table",
            positional: false,
            file: CARTESIAN,
            way: Way::Instancing,
            rows: &[
                ("C1 – C2", (12, 16, Some((9, 1.883)))),
                ("C3 – C4", (12, 16, Some((9, 2.200)))),
                ("C5 – C8", (6, 14, Some((6, 0.717)))),
                ("C6 – C9", (6, 14, Some((6, 0.717)))),
                (TOGETHER, (20, 65, Some((20, 10.23)))),
            ],
        }],
    },
];
