//! Kinematic pairs in the ways in which they may be written.

#![allow(clippy::unwrap_used)]

use super::builder::{Order, Product, Text};
use crate::{Assembly, NoteKind, PairMotion, read};

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// Two pins of one product, the second 30 mm along x, as links whose frames meet at 30 mm: the text, the numbers of both placements and both
/// links.
struct Mechanism {
    text: Text,
    items: [u64; 2],
    links: [u64; 2],
    representations: [u64; 2],
}

impl Mechanism {
    /// With `meant` it is said which occurrence each link is; else the file is of AP214, where it cannot be.
    fn new(meant: bool) -> Self {
        let mut text = Text::new();
        let whole = text.product("whole", &[]);
        let mut products: Vec<Product> = Vec::new();
        for name in ["pin", "other"] {
            let faces = text.pin(1.0, (0.0, 5.0));
            products.push(text.product(name, &faces));
        }
        // Where occurrences are said, both are of one product.
        let second = if meant { products[0] } else { products[1] };
        let mut usages = Vec::new();
        for (product, x) in [(products[0], 0.0), (second, 30.0)] {
            usages.push(text.next_number());
            let at = ([x, 0.0, 0.0], Z, X);
            text.place("", whole, product, at, Order::default());
        }
        let context = text.context();
        let (mut items, mut links, mut representations) = ([0; 2], [0; 2], [0; 2]);
        for (place, product) in [products[0], second].into_iter().enumerate() {
            let x = [30.0, 0.0][place];
            let item = text.placement([x, 0.0, 0.0], Z, X);
            let (link, shown) = match meant {
                true => {
                    let link = text.add("KINEMATIC_LINK('')");
                    let shown =
                        format!("RIGID_LINK_REPRESENTATION('',(#{item}),#{context},#{link})");
                    (link, text.add(&shown))
                }
                false => {
                    let link = text.add("KINEMATIC_LINK()");
                    let shown = format!("KINEMATIC_LINK_REPRESENTATION('',(#{item}),#{context})");
                    let shown = text.add(&shown);
                    text.add(&format!(
                        "KINEMATIC_LINK_REPRESENTATION_RELATION(#{link},#{shown})"
                    ));
                    (link, shown)
                }
            };
            let shape = product.representation;
            let association = text.add(&format!(
                "KINEMATIC_LINK_REPRESENTATION_ASSOCIATION('','',#{shown},#{shape})"
            ));
            if meant {
                let usage = usages[place];
                let property = text.add(&format!(
                    "PRODUCT_DEFINITION_RELATIONSHIP_KINEMATICS('','',#{usage})"
                ));
                text.add(&format!(
                    "CONTEXT_DEPENDENT_KINEMATIC_LINK_REPRESENTATION(#{association},#{property})"
                ));
            }
            (items[place], links[place], representations[place]) = (item, link, shown);
        }
        Self {
            text,
            items,
            links,
            representations,
        }
    }

    fn read(&self) -> Assembly {
        let text = self.text.finished();
        read(text.as_bytes()).unwrap_or_else(|error| panic!("{error}"))
    }
}

const HINGE: PairMotion = PairMotion::Free {
    translations: [false; 3],
    rotations: [false, false, true],
};

#[test]
fn a_pair_is_the_same_in_one_record_and_in_one_for_each_type() {
    for complex in [false, true] {
        let mut made = Mechanism::new(true);
        let ([a, b], [one, two]) = (made.items, made.links);
        let joint = made.text.add(&format!("KINEMATIC_JOINT('',#{one},#{two})"));
        let pair = match complex {
            false => format!("REVOLUTE_PAIR('',*,$,#{a},#{b},#{joint},*,*,*,*,*,*)"),
            true => format!(
                "(GEOMETRIC_REPRESENTATION_ITEM()ITEM_DEFINED_TRANSFORMATION('',$,#{a},#{b})\
                 KINEMATIC_PAIR(#{joint})LOW_ORDER_KINEMATIC_PAIR(*,*,*,*,*,*)\
                 REPRESENTATION_ITEM('')REVOLUTE_PAIR())"
            ),
        };
        let pair = made.text.add(&pair);
        // It relates links, and places no part.
        let [first, second] = made.representations;
        made.text.add(&format!(
            "(GEOMETRIC_REPRESENTATION_ITEM()PAIR_REPRESENTATION_RELATIONSHIP()REPRESENTATION_ITEM('')\
             REPRESENTATION_RELATIONSHIP('','',#{first},#{second})\
             REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{pair}))"
        ));
        let assembly = made.read();
        assert!(assembly.notes.is_empty(), "{:?}", assembly.notes);
        let found = &assembly.pairs[0];
        assert_eq!((found.parts, found.motion), ((0, 1), HINGE));
        assert_eq!(found.frames.0, found.frames.1);
        assert!((found.frames.0.translation.x - 0.03).abs() < 1e-12);
    }
}

#[test]
fn pairs_of_ap214_have_no_flags_and_no_occurrences() {
    let mut made = Mechanism::new(false);
    let ([a, b], [one, two]) = (made.items, made.links);
    let joint = made.text.add(&format!("KINEMATIC_JOINT(#{one},#{two})"));
    made.text
        .add(&format!("SCREW_PAIR('',$,#{a},#{b},#{joint},2.)"));
    let assembly = made.read();
    assert!(assembly.notes.is_empty(), "{:?}", assembly.notes);
    let lead = PairMotion::Screw { lead: 0.002 };
    assert_eq!(assembly.pairs[0].motion, lead);
}

#[test]
fn a_link_that_could_be_several_parts_is_told() {
    let mut made = Mechanism::new(true);
    let ([a, b], [one, two]) = (made.items, made.links);
    let joint = made.text.add(&format!("KINEMATIC_JOINT('',#{one},#{two})"));
    made.text.add(&format!(
        "REVOLUTE_PAIR('',*,$,#{a},#{b},#{joint},*,*,*,*,*,*)"
    ));
    let text = made.text.finished();
    let text = text.replace("CONTEXT_DEPENDENT_KINEMATIC_LINK_REPRESENTATION(", "OTHER(");
    let assembly = read(text.as_bytes()).unwrap();
    assert!(assembly.pairs.is_empty());
    let notes: Vec<&str> = assembly.notes.iter().map(|n| n.text.as_str()).collect();
    assert!(
        notes.len() == 1 && notes[0].contains("several times"),
        "{notes:?}"
    );
    assert_eq!(assembly.notes[0].kind, NoteKind::MayJoin);
}
