//! What parts look like: colours by what a link or joint does in the motion shown.

/// A colour with opacity; components from 0 to 1, sRGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour {
    /// Red.
    pub red: f64,
    /// Green.
    pub green: f64,
    /// Blue.
    pub blue: f64,
    /// 1 is opaque, 0 invisible.
    pub opacity: f64,
}

impl Colour {
    const fn opaque(red: f64, green: f64, blue: f64) -> Self {
        Self {
            red,
            green,
            blue,
            opacity: 1.0,
        }
    }

    /// The same hue, seen through.
    #[must_use]
    pub fn with_opacity(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }
}

/// What a link or a joint does in the motion shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Role {
    /// Driven from outside.
    Driven,
    /// Moves because others do.
    #[default]
    Moving,
    /// Does not move anywhere on the branch (of a link: relative to the ground).
    Locked,
    /// Can move while everything else stands still.
    Idle,
}

impl Role {
    /// The word for it, as in reports.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Driven => "driven",
            Self::Moving => "moving",
            Self::Locked => "locked",
            Self::Idle => "idle",
        }
    }
}

/// The roles of all links and joints, by index. What is missing moves.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Roles {
    /// By link index; that of the ground is not looked at.
    pub links: Vec<Role>,
    /// By joint index.
    pub joints: Vec<Role>,
}

impl Roles {
    /// The role of a link.
    #[must_use]
    pub fn link(&self, index: usize) -> Role {
        self.links.get(index).copied().unwrap_or_default()
    }

    /// The role of a joint.
    #[must_use]
    pub fn joint(&self, index: usize) -> Role {
        self.joints.get(index).copied().unwrap_or_default()
    }
}

/// The link held fixed.
pub const GROUND: Colour = Colour::opaque(0.33, 0.34, 0.37);
/// Lines between the two sides of a loop that does not close.
pub const GAP: Colour = Colour::opaque(0.90, 0.10, 0.10);
/// Axes of joints.
pub const AXIS: Colour = Colour::opaque(0.45, 0.47, 0.50);
/// Words beside a picture.
pub const LABEL: Colour = Colour::opaque(0.60, 0.62, 0.66);

const LOCKED: Colour = Colour::opaque(0.58, 0.40, 0.27);
const IDLE: Colour = Colour::opaque(0.62, 0.38, 0.78);
const DRIVEN: Colour = Colour::opaque(0.18, 0.66, 0.28);
const MOVING_JOINT: Colour = Colour::opaque(0.96, 0.74, 0.18);

/// Neighbours in a chain are told apart by taking these in turn.
const MOVING_LINKS: [Colour; 4] = [
    Colour::opaque(0.15, 0.46, 0.80),
    Colour::opaque(0.05, 0.62, 0.62),
    Colour::opaque(0.42, 0.44, 0.86),
    Colour::opaque(0.36, 0.68, 0.92),
];

/// The colour of a link other than the ground.
#[must_use]
pub fn link_colour(index: usize, role: Role) -> Colour {
    match role {
        Role::Locked => LOCKED,
        Role::Idle => IDLE,
        Role::Driven | Role::Moving => MOVING_LINKS[index % MOVING_LINKS.len()],
    }
}

/// The colour of a joint's symbol.
#[must_use]
pub fn joint_colour(role: Role) -> Colour {
    match role {
        Role::Driven => DRIVEN,
        Role::Moving => MOVING_JOINT,
        Role::Locked => LOCKED,
        Role::Idle => IDLE,
    }
}
