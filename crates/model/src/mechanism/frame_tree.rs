//! Frames of which each is given in another one: the way between any two of them, soon.
//!
//! A file may give ten thousand frames, each in the one before, and a joint between any two of them. A walk along the whole chain for each
//! joint takes the square of that. So every frame knows, beside the one that it is given in, one farther up, and the frame from there to it.
//! These jumps are the skew-binary ones of Myers (1983, "An applicative random-access stack", Information Processing Letters 17): two jumps
//! of one length that follow one another, and a step, are a jump. Memory is linear, a way has a number of frames logarithmic in its length.
//!
//! Only the way from the nearest common ancestor counts, as in a walk, so that what lies far above two frames adds no rounding. Ways of
//! ordinary length are walked step by step, and no product of frames comes between a file's numbers and what reads them.

use super::Frame;

/// Longer ways than this, in frames, are taken in jumps. Time alone hangs on it: walked or jumped, a way leads to one place but for rounding
/// (`a_long_way_leads_to_where_a_short_one_does` on both sides of it).
const LONGEST_WALK: usize = 64;

/// Frames by their index, each given in its parent; roots have none.
///
/// ```
/// # use kutzbach_model as kutzbach;
/// use kutzbach::mechanism::{Frame, FrameTree};
/// # fn found() -> Option<()> {
/// let (up, side) = (Frame::at_point([0.0, 0.0, 3.0])?, Frame::at_point([2.0, 0.0, 0.0])?);
/// let mut tree = FrameTree::new(vec![None, Some(0), Some(0)]).ok()?;
/// tree.set_frames(vec![Frame::identity(), up.clone(), side.clone()], |chain| Frame::between(&[], chain));
/// assert_eq!(tree.way(1, 2)?, [[&up], [&side]]);
/// assert_eq!(FrameTree::new(vec![None, Some(2), Some(1)]).unwrap_err(), [1, 2]);
/// # Some(()) }
/// # assert!(found().is_some());
/// ```
#[derive(Clone, Debug, Default)]
pub struct FrameTree {
    /// A root's own index for a root.
    parents: Vec<usize>,
    /// How many frames are above each one.
    depths: Vec<usize>,
    /// A frame farther up, or the parent.
    jumps: Vec<usize>,
    /// Each in its parent.
    frames: Vec<Frame>,
    /// Each seen from where its jump leads; `None` where that is the parent, or it is not finite. Empty where every way is walked.
    along: Vec<Option<Frame>>,
}

impl FrameTree {
    /// The tree of these parents, in linear time. All frames are the identity until they are [set](Self::set_frames).
    ///
    /// # Errors
    /// The indices of frames that run in a circle, each given in the next one; a frame that is its own parent is one. What is given in an index that no
    /// frame has counts as a root.
    pub fn new(mut parents: Vec<Option<usize>>) -> Result<Self, Vec<usize>> {
        let count = parents.len();
        for parent in &mut parents {
            *parent = parent.filter(|parent| *parent < count);
        }
        let depths = depths_of(&parents)?;
        let own = parents.into_iter().enumerate();
        let parents: Vec<usize> = own.map(|(node, parent)| parent.unwrap_or(node)).collect();
        let mut tree = Self {
            jumps: parents.clone(),
            frames: vec![Frame::identity(); count],
            along: Vec::new(),
            depths,
            parents,
        };
        for node in tree.root_first() {
            let parent = tree.parents[node];
            let middle = tree.jumps[parent];
            let first = tree.depths[parent] - tree.depths[middle];
            let second = tree.depths[middle] - tree.depths[tree.jumps[middle]];
            tree.jumps[node] = match first == second {
                true => tree.jumps[middle],
                false => parent,
            };
        }
        Ok(tree)
    }

    /// How many frames there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.parents.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.parents.is_empty()
    }

    /// Whether there may be a way that is taken in jumps.
    #[must_use]
    pub fn has_long_ways(&self) -> bool {
        self.depths.iter().any(|depth| 2 * depth > LONGEST_WALK)
    }

    /// Whether the way between two frames is taken in jumps; not where there is none.
    #[must_use]
    pub fn is_long(&self, from: usize, to: usize) -> bool {
        self.top_of_way(from, to)
            .is_some_and(|(_, is_long)| is_long)
    }

    /// The frame at the root above one.
    #[must_use]
    pub fn root(&self, node: usize) -> Option<usize> {
        let mut at = node;
        while *self.depths.get(at)? > 0 {
            at = self.jumps[at];
        }
        Some(at)
    }

    /// Says where the frames are, each in its parent. `chain` is the frame at the end of several of which each is given in the one before,
    /// `None` where it is not finite; it is asked for less than one chain of three per frame, and not at all where every way is short.
    pub fn set_frames(&mut self, frames: Vec<Frame>, chain: impl Fn(&[&Frame]) -> Option<Frame>) {
        let count = self.len();
        self.frames = frames;
        self.frames.resize_with(count, Frame::identity);
        self.along = Vec::new();
        if !self.has_long_ways() {
            return;
        }
        self.along.resize_with(count, || None);
        for node in self.root_first() {
            let parent = self.parents[node];
            if self.jumps[node] == parent {
                continue;
            }
            let parts = [self.jumps[parent], parent].map(|part| self.last_jump(part));
            let [Some(first), Some(second)] = parts else {
                continue;
            };
            self.along[node] = chain(&[first, second, &self.frames[node]]);
        }
    }

    /// The frames from the nearest common ancestor of two frames down to each of them; of a long way several as one. `None` where there is
    /// no such ancestor or frame, or something on the way is not finite.
    ///
    /// Cost: proportional to the length of the way, or to its logarithm and that of the depth where it is long.
    #[must_use]
    pub fn way(&self, from: usize, to: usize) -> Option<[Vec<&Frame>; 2]> {
        let (top, is_long) = self.top_of_way(from, to)?;
        Some([self.down(top, from, is_long)?, self.down(top, to, is_long)?])
    }

    /// The nearest common ancestor of two frames, and whether the way between them is long.
    fn top_of_way(&self, from: usize, to: usize) -> Option<(usize, bool)> {
        let (one, other) = (*self.depths.get(from)?, *self.depths.get(to)?);
        let top = self.meeting(from, to)?;
        Some((top, one + other - 2 * self.depths[top] > LONGEST_WALK))
    }

    /// The frames from one down to another one below it.
    fn down(&self, top: usize, end: usize, in_jumps: bool) -> Option<Vec<&Frame>> {
        let (mut found, mut at) = (Vec::new(), end);
        while at != top {
            let higher = self.higher(at, self.depths[top]);
            match in_jumps && higher != self.parents[at] {
                true => {
                    found.push(self.along.get(at)?.as_ref()?);
                    at = higher;
                }
                false => {
                    found.push(&self.frames[at]);
                    at = self.parents[at];
                }
            }
        }
        found.reverse();
        Some(found)
    }

    /// The nearest common ancestor.
    fn meeting(&self, from: usize, to: usize) -> Option<usize> {
        let (mut a, mut b) = (from, to);
        while a != b {
            let (one, other) = (self.depths[a], self.depths[b]);
            if one > other {
                a = self.higher(a, other);
            } else if other > one {
                b = self.higher(b, one);
            } else if one == 0 {
                return None;
            } else if self.jumps[a] != self.jumps[b] {
                // Frames of one depth jump to one depth.
                (a, b) = (self.jumps[a], self.jumps[b]);
            } else {
                (a, b) = (self.parents[a], self.parents[b]);
            }
        }
        Some(a)
    }

    /// Where the jump of a frame leads, or its parent where that is above a depth.
    fn higher(&self, node: usize, depth: usize) -> usize {
        let jump = self.jumps[node];
        match self.depths[jump] >= depth {
            true => jump,
            false => self.parents[node],
        }
    }

    /// The frame from where the jump of a node leads to the node.
    fn last_jump(&self, node: usize) -> Option<&Frame> {
        match self.jumps[node] == self.parents[node] {
            true => Some(&self.frames[node]),
            false => self.along[node].as_ref(),
        }
    }

    /// All frames but the roots, each behind its parent.
    fn root_first(&self) -> Vec<usize> {
        let below = |node: &usize| self.depths[*node] > 0;
        let mut order: Vec<usize> = (0..self.len()).filter(below).collect();
        order.sort_by_key(|node| self.depths[*node]);
        order
    }
}

/// How many frames are above each one; where they run in a circle, that, each given in the next one.
fn depths_of(parents: &[Option<usize>]) -> Result<Vec<usize>, Vec<usize>> {
    let count = parents.len();
    let mut depths: Vec<Option<usize>> = vec![None; count];
    let mut met_by = vec![count; count];
    for start in 0..count {
        let (mut walk, mut at) = (Vec::new(), start);
        let above = loop {
            if let Some(depth) = depths[at] {
                break Some(depth);
            }
            if met_by[at] == start {
                return Err(walk.into_iter().skip_while(|node| *node != at).collect());
            }
            met_by[at] = start;
            walk.push(at);
            let Some(parent) = parents[at] else {
                break None;
            };
            at = parent;
        };
        let first = above.map_or(0, |above| above + 1);
        for (depth, node) in (first..).zip(walk.into_iter().rev()) {
            depths[node] = Some(depth);
        }
    }
    Ok(depths.into_iter().map(Option::unwrap_or_default).collect())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn at(x: f64) -> Frame {
        Frame::at_point([x, 0.0, 0.0]).unwrap()
    }

    /// A long chain and a branch off each of its frames, each frame a metre from its parent.
    fn comb(teeth: usize) -> FrameTree {
        let chain = (0..teeth).map(|i: usize| i.checked_sub(1));
        let branches = (0..teeth).map(Some);
        let mut tree = FrameTree::new(chain.chain(branches).collect()).unwrap();
        tree.set_frames(vec![at(1.0); 2 * teeth], |chain| Frame::between(&[], chain));
        tree
    }

    fn length(frames: &[&Frame]) -> f64 {
        frames.iter().map(|frame| frame.position[0].value()).sum()
    }

    #[test]
    fn a_way_is_as_long_as_a_walk_and_has_few_frames() {
        let teeth = 3000;
        let tree = comb(teeth);
        for (a, b) in [
            (0, 0),
            (5, 70),
            (2999, 0),
            (1, 2998),
            (1234, 1234),
            (1000, 2777),
        ] {
            let [up, down] = tree.way(a, b).unwrap();
            assert_eq!(
                (length(&up), length(&down)),
                (a.saturating_sub(b) as f64, b.saturating_sub(a) as f64)
            );
            // From tooth to tooth.
            let [up, down] = tree.way(teeth + a, teeth + b).unwrap();
            let own = if a == b { 0.0 } else { 1.0 };
            assert_eq!(length(&up), a.saturating_sub(b) as f64 + own);
            assert_eq!(length(&down), b.saturating_sub(a) as f64 + own);
            assert!(
                up.len() + down.len() <= LONGEST_WALK,
                "{a} {b}: {} {}",
                up.len(),
                down.len()
            );
        }
    }

    #[test]
    fn short_ways_are_walked_step_by_step() {
        let tree = comb(3000);
        let [up, down] = tree.way(2900, 2860).unwrap();
        assert_eq!((up.len(), down.len()), (40, 0));
    }

    #[test]
    fn circles_and_roots() {
        let circle = |parents: [Option<usize>; 4]| FrameTree::new(parents.to_vec()).unwrap_err();
        assert_eq!(circle([None, Some(3), Some(1), Some(2)]), [1, 3, 2]);
        assert_eq!(circle([None, Some(2), Some(3), Some(2)]), [2, 3]);
        // One that is given in itself is no root.
        assert_eq!(circle([None, Some(0), Some(2), Some(7)]), [2]);
        // Two roots have nothing in common.
        let tree = FrameTree::new(vec![None, None, Some(0)]).unwrap();
        assert!(tree.way(2, 1).is_none());
        assert!(tree.way(2, 7).is_none());
        assert_eq!(FrameTree::new(Vec::new()).unwrap().len(), 0);
    }
}
