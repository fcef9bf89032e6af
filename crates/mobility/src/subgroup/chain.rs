//! Chains of screws and of what replaced whole loops, between two links.

use super::axes::Axes;
use super::clear;
use kutzbach_math::group::{Gauge, GroupError, Margin, ScrewSystem, Subalgebra, Twist};
use kutzbach_model::mechanism::JointKind;

/// One member of a chain: a smooth map into SE(3), the identity at the pose.
#[derive(Clone, Debug)]
pub enum Piece {
    /// Some screws of a joint that are not taken apart.
    Factor {
        /// The joint.
        joint: usize,
        /// Number of the subgroup in the joint's product of subgroups. Factors of one subgroup may change places.
        subgroup: usize,
        /// The joint's variable of the first screw; the others follow.
        first: usize,
        /// The screws.
        twists: Vec<Twist>,
    },
    /// What replaced a loop.
    Replaced(Box<Replaced>),
}

/// A manifold of displacements that replaced a loop.
#[derive(Clone, Debug)]
pub struct Replaced {
    /// The joints of the loop.
    pub joints: Vec<usize>,
    /// Dimension of the manifold that is mapped to displacements.
    pub freedom: usize,
    /// The image of its tangent space at the pose, W.
    pub span: ScrewSystem,
    /// The algebra of a subgroup that holds all its displacements, K.
    pub algebra: Subalgebra,
}

impl Piece {
    /// Number of variables.
    pub fn freedom(&self) -> usize {
        match self {
            Self::Factor { twists, .. } => twists.len(),
            Self::Replaced(loop_) => loop_.freedom,
        }
    }

    /// The joints in it.
    pub fn joints(&self) -> &[usize] {
        match self {
            Self::Factor { joint, .. } => std::slice::from_ref(joint),
            Self::Replaced(loop_) => &loop_.joints,
        }
    }
}

/// The pieces of a joint, from its screws in the order of its variables.
///
/// A joint of [`JointKind::is_subgroup`] is one subgroup, every other a product of two. Planar motions, cylindrical ones and
/// the like are translations times the rotations or screws about an axis, in either order; where the translations end
/// depends on nothing but the joint. How a ball or a plane's translations could be taken apart depends on the choice of
/// axes, and they are left whole.
pub fn of_joint(joint: usize, kind: JointKind, screws: &[Twist]) -> Vec<Piece> {
    let subgroups: &[&[usize]] = match kind {
        JointKind::Fixed => &[],
        JointKind::Revolute | JointKind::Prismatic | JointKind::Screw => &[&[1]],
        JointKind::Cylindrical => &[&[1, 1]],
        JointKind::Universal => &[&[1], &[1]],
        JointKind::PlanarTranslation => &[&[2]],
        JointKind::Planar | JointKind::TranslatingScrew => &[&[2, 1]],
        JointKind::Spherical | JointKind::Translational => &[&[3]],
        JointKind::Schoenflies => &[&[3, 1]],
        JointKind::PointOnLine => &[&[3], &[1]],
        JointKind::LineOnPlane => &[&[1], &[2, 1]],
        JointKind::PointOnPlane => &[&[3], &[2]],
        // The two swings of the rod turn about its first point.
        JointKind::Distance => &[&[2], &[3]],
    };
    let mut first = 0;
    let mut pieces = Vec::new();
    for (subgroup, factors) in subgroups.iter().enumerate() {
        for &number in *factors {
            pieces.push(Piece::Factor {
                joint,
                subgroup,
                first,
                twists: screws.iter().skip(first).take(number).copied().collect(),
            });
            first += number;
        }
    }
    pieces
}

/// Freedoms of some pieces together.
pub fn freedom<'a>(pieces: impl IntoIterator<Item = &'a Piece>) -> usize {
    pieces.into_iter().map(Piece::freedom).sum()
}

/// The joints of some pieces, each once, in order.
pub fn joints<'a>(pieces: impl IntoIterator<Item = &'a Piece>) -> Vec<usize> {
    let mut joints: Vec<usize> = Vec::new();
    for joint in pieces.into_iter().flat_map(Piece::joints) {
        if !joints.contains(joint) {
            joints.push(*joint);
        }
    }
    joints
}

/// The linear space W spanned by some pieces.
pub fn span<'a>(
    pieces: impl IntoIterator<Item = &'a Piece>,
    gauge: &Gauge,
) -> Result<ScrewSystem, GroupError> {
    let mut twists = Vec::new();
    let mut spaces = Vec::new();
    for piece in pieces {
        match piece {
            Piece::Factor { twists: own, .. } => twists.extend(own),
            Piece::Replaced(loop_) => spaces.push(&loop_.span),
        }
    }
    let screws = ScrewSystem::span(&twists, gauge)?;
    spaces.into_iter().try_fold(screws, |sum, w| sum.sum(w))
}

/// The algebra K of a subgroup that holds all displacements of some pieces.
pub fn enclosing<'a>(
    pieces: impl IntoIterator<Item = &'a Piece>,
    gauge: &Gauge,
) -> Result<Subalgebra, GroupError> {
    let mut twists = Vec::new();
    let mut spaces = Vec::new();
    for piece in pieces {
        match piece {
            Piece::Factor { twists: own, .. } => twists.extend(own),
            Piece::Replaced(loop_) => spaces.push(loop_.algebra.system()),
        }
    }
    let screws = ScrewSystem::span(&twists, gauge)?;
    let all = spaces.into_iter().try_fold(screws, |sum, k| sum.sum(k))?;
    Subalgebra::generated_by_system(&all)
}

/// The subgroup that some pieces are a submersion onto: their span, where it is closed under the bracket and no
/// displacement of theirs leaves its subgroup. `None` where it is not, or not clearly.
pub fn swept<'a>(
    pieces: impl IntoIterator<Item = &'a Piece> + Clone,
    gauge: &Gauge,
) -> Result<Option<Subalgebra>, GroupError> {
    if !may_close(pieces.clone(), gauge) {
        return Ok(None);
    }
    let span = span(pieces.clone(), gauge)?;
    swept_by(pieces, &span)
}

/// [`swept`] where the span is known.
pub fn swept_by<'a>(
    pieces: impl IntoIterator<Item = &'a Piece>,
    span: &ScrewSystem,
) -> Result<Option<Subalgebra>, GroupError> {
    // No subalgebra of se(3) has dimension 5.
    if span.dimension() == 5 || !clear(span.margin()) {
        return Ok(None);
    }
    let Some(algebra) = Subalgebra::from_system(span)?.filter(|a| clear(a.margin())) else {
        return Ok(None);
    };
    for piece in pieces {
        if let Piece::Replaced(loop_) = piece
            && algebra.dimension() < 6
            && !within(&loop_.algebra, &algebra)?
        {
            return Ok(None);
        }
    }
    Ok(Some(algebra))
}

/// A quick look that spares most decompositions: false only where the span is certainly not closed, or only just.
///
/// Of less than six freedoms, turns whose algebra has six dimensions do not span it; see [`Axes`].
pub fn may_close<'a>(pieces: impl IntoIterator<Item = &'a Piece> + Clone, gauge: &Gauge) -> bool {
    if freedom(pieces.clone()) >= 6 {
        return true;
    }
    let mut axes = Axes::new(gauge);
    for piece in pieces {
        let Piece::Factor { twists, .. } = piece else {
            return true;
        };
        twists.iter().for_each(|twist| axes.add(twist));
    }
    !axes.generate_everything()
}

/// Whether one algebra clearly lies in another.
fn within(inner: &Subalgebra, outer: &Subalgebra) -> Result<bool, GroupError> {
    let common = inner.intersection(outer)?;
    Ok(common.dimension() == inner.dimension() && clear(common.margin()))
}

impl Replaced {
    /// The worst margin behind the two spaces.
    pub fn margin(&self) -> Margin {
        self.span.margin().and(self.algebra.margin())
    }
}

/// Freedoms of a chain that change nothing between its ends, where the chain is a submersion onto a subgroup or onto a
/// product of two: then every displacement is reached by a manifold of variables of that dimension.
pub fn without_effect(pieces: &[Piece], gauge: &Gauge) -> Result<usize, GroupError> {
    let reached = span(pieces, gauge)?;
    let surplus = freedom(pieces).saturating_sub(reached.dimension());
    if surplus == 0 || !clear(reached.margin()) {
        return Ok(0);
    }
    for cut in 0..pieces.len() {
        let (before, after) = pieces.split_at(cut);
        if swept(before, gauge)?.is_some() && swept(after, gauge)?.is_some() {
            return Ok(surplus);
        }
    }
    Ok(0)
}
