//! The reduction's sequence of clusters and the ternary tree of the decomposition, as text and data.

use crate::analysis::{Decomposition, Merge, Part, decompose, reduce};
use crate::named::NamedSketch;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fmt::Write;

/// Lines beyond so many of each are counted, not written.
const MOST_LINES: usize = 100;

/// Both of a sketch without relations of more than two elements.
#[derive(Clone, Debug)]
pub struct ClusterWords<'a> {
    named: &'a NamedSketch,
    merges: Vec<Merge>,
    tree: Decomposition,
}

impl<'a> ClusterWords<'a> {
    /// Reduces and decomposes; `None` where there are relations, which neither knows.
    #[must_use]
    pub fn of(named: &'a NamedSketch) -> Option<Self> {
        let graph = named.sketch.graph();
        let known = named.sketch.relations().is_empty();
        known.then(|| Self {
            merges: reduce(graph).merges,
            tree: decompose(graph),
            named,
        })
    }

    fn names(&self, elements: impl IntoIterator<Item = usize>) -> Vec<&'a str> {
        let named = self.named;
        elements.into_iter().map(|e| &*named.names[e]).collect()
    }

    fn edge(&self, edge: usize) -> [usize; 2] {
        self.named.sketch.graph().edges()[edge]
    }

    /// A constraint by its elements, a cluster by its number.
    fn part(&self, part: usize) -> String {
        let edges = self.named.sketch.graph().edges().len();
        match part.checked_sub(edges) {
            None => self.names(self.edge(part)).join(" "),
            Some(merge) => format!("cluster {}", merge + 1),
        }
    }

    /// Everything for a person.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::from("reduction:\n");
        let edges = self.named.sketch.graph().edges().len();
        let mut sets: Vec<BTreeSet<usize>> = Vec::new();
        for (i, merge) in self.merges.iter().enumerate().take(MOST_LINES) {
            let mut set: BTreeSet<usize> = BTreeSet::new();
            for &part in &merge.parts {
                match part.checked_sub(edges) {
                    None => set.extend(self.edge(part)),
                    Some(merge) => set.extend(&sets[merge]),
                }
            }
            let parts = merge.parts.map(|p| self.part(p)).join(", ");
            let names = self.names(set.iter().copied()).join(" ");
            let shared = self.names(merge.shared).join(" ");
            let _ = writeln!(
                text,
                "cluster {}: {names}, of {parts}, which share {shared}",
                i + 1
            );
            sets.push(set);
        }
        more(&mut text, self.merges.len());
        text.push_str("ternary tree:\n");
        let mut open = vec![(0, &self.tree.root)];
        let mut lines = 0;
        while let Some((depth, part)) = open.pop() {
            lines += 1;
            if lines > MOST_LINES {
                continue;
            }
            let (elements, ending) = match part {
                Part::Edge(edge) => (self.edge(*edge).to_vec(), String::new()),
                Part::Stuck(elements) => (elements.clone(), ", which do not fall apart".to_owned()),
                Part::Set(set) => {
                    let shared = self.names(self.tree.sets[*set].shared).join(" ");
                    let elements = self.elements(*set).into_iter().collect();
                    (elements, format!(", shared: {shared}"))
                }
            };
            let names = self.names(elements).join(" ");
            let _ = writeln!(text, "{}{names}{ending}", "  ".repeat(depth + 1));
            if let Part::Set(set) = part {
                let parts = self.tree.sets[*set].parts.iter().rev();
                open.extend(parts.map(|p| (depth + 1, p)));
            }
        }
        more(&mut text, lines);
        text
    }

    fn elements(&self, set: usize) -> BTreeSet<usize> {
        let mut all = BTreeSet::new();
        let mut open = vec![set];
        while let Some(set) = open.pop() {
            for part in &self.tree.sets[set].parts {
                match part {
                    Part::Edge(edge) => all.extend(self.edge(*edge)),
                    Part::Set(inner) => open.push(*inner),
                    Part::Stuck(elements) => all.extend(elements),
                }
            }
        }
        all
    }

    /// Everything for a program. Parts of a cluster below the number of constraints are these, others clusters, both from zero.
    #[must_use]
    pub fn data(&self) -> Value {
        let merge = |m: &Merge| json!({ "parts": m.parts, "shared": self.names(m.shared) });
        let part = |part: &Part| match part {
            Part::Edge(edge) => json!({ "constraint": edge }),
            Part::Set(set) => json!({ "set": set }),
            Part::Stuck(elements) => json!({ "stuck": self.names(elements.iter().copied()) }),
        };
        let set = |s: &crate::analysis::SetDecomposition| {
            let parts: Vec<Value> = s.parts.iter().map(part).collect();
            json!({ "parts": parts, "shared": self.names(s.shared) })
        };
        json!({
            "reduction": self.merges.iter().map(merge).collect::<Vec<Value>>(),
            "ternary_tree": {
                "root": part(&self.tree.root),
                "sets": self.tree.sets.iter().map(set).collect::<Vec<Value>>(),
            },
        })
    }
}

fn more(text: &mut String, count: usize) {
    if count > MOST_LINES {
        let _ = writeln!(text, "and {} more", count - MOST_LINES);
    }
}
