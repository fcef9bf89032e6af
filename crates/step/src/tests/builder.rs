//! A small writer of STEP texts: entities by number, placements, products and their occurrences.

/// A STEP text that grows.
pub(super) struct Text {
    lines: Vec<String>,
    /// What one unit of length is in millimetres: coordinates are given in millimetres and written in units.
    unit: f64,
    /// The number of the context.
    context: u64,
    /// Numbers of the contexts of a product and of its definition.
    contexts: (u64, u64),
}

/// A product that has been written.
#[derive(Clone, Copy)]
pub(super) struct Product {
    pub definition: u64,
    pub representation: u64,
    /// The placement in its representation that is its own frame.
    pub origin: u64,
}

/// In which order an occurrence is written.
#[derive(Clone, Copy, Default)]
pub(super) struct Order {
    pub items_exchanged: bool,
    pub representations_exchanged: bool,
}

/// Units of a text.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Unit {
    Millimetre,
    Metre,
    Inch,
}

impl Text {
    /// A text in millimetres and radians.
    pub fn new() -> Self {
        Self::in_units(Unit::Millimetre, false)
    }

    pub fn in_units(unit: Unit, degrees: bool) -> Self {
        let mut text = Self {
            lines: Vec::new(),
            unit: 1.0,
            context: 0,
            contexts: (0, 0),
        };
        text.use_context(unit, degrees);
        let application = text.add("APPLICATION_CONTEXT('mechanical design')");
        text.contexts = (
            text.add(&format!("PRODUCT_CONTEXT('',#{application},'mechanical')")),
            text.add(&format!(
                "PRODUCT_DEFINITION_CONTEXT('part definition',#{application},'design')"
            )),
        );
        text
    }

    /// Writes a context; what follows is in its units.
    pub fn use_context(&mut self, unit: Unit, degrees: bool) {
        let milli = self.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
        let (length, size) = match unit {
            Unit::Millimetre => (milli, 1.0),
            Unit::Metre => (
                self.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.))"),
                1000.0,
            ),
            Unit::Inch => {
                let measure = self.add(&format!(
                    "LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#{milli})"
                ));
                let inch =
                    format!("(CONVERSION_BASED_UNIT('INCH',#{measure})LENGTH_UNIT()NAMED_UNIT(*))");
                (self.add(&inch), 25.4)
            }
        };
        let radian = self.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
        let angle = if degrees {
            let measure = self.add(&format!(
                "PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(0.0174532925),#{radian})"
            ));
            self.add(&format!(
                "(CONVERSION_BASED_UNIT('DEGREE',#{measure})NAMED_UNIT(*)PLANE_ANGLE_UNIT())"
            ))
        } else {
            radian
        };
        let digits = self.add(&format!(
            "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-06),#{milli},'distance_accuracy_value','')"
        ));
        self.unit = size;
        self.context = self.add(&format!(
            "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{digits}))\
             GLOBAL_UNIT_ASSIGNED_CONTEXT((#{length},#{angle}))REPRESENTATION_CONTEXT('',''))"
        ));
    }

    /// Adds an entity; its number.
    pub fn add(&mut self, entity: &str) -> u64 {
        let number = self.lines.len() as u64 + 1;
        self.lines.push(format!("#{number}={entity};"));
        number
    }

    /// The number that the next entity will have.
    pub fn next_number(&self) -> u64 {
        self.lines.len() as u64 + 1
    }

    /// A length of so many millimetres as it is written.
    pub fn length(&self, millimetres: f64) -> String {
        format!("{:?}", millimetres / self.unit)
    }

    pub fn point(&mut self, [x, y, z]: [f64; 3]) -> u64 {
        let (x, y, z) = (self.length(x), self.length(y), self.length(z));
        self.add(&format!("CARTESIAN_POINT('',({x},{y},{z}))"))
    }

    pub fn direction(&mut self, [x, y, z]: [f64; 3]) -> u64 {
        self.add(&format!("DIRECTION('',({x:?},{y:?},{z:?}))"))
    }

    pub fn placement(&mut self, origin: [f64; 3], z: [f64; 3], x: [f64; 3]) -> u64 {
        let (origin, z, x) = (self.point(origin), self.direction(z), self.direction(x));
        self.add(&format!("AXIS2_PLACEMENT_3D('',#{origin},#{z},#{x})"))
    }

    fn identity(&mut self) -> u64 {
        self.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0])
    }

    /// A product with a solid of these faces; without faces an assembly.
    pub fn product(&mut self, name: &str, faces: &[u64]) -> Product {
        let origin = self.identity();
        let context = self.context;
        let representation = if faces.is_empty() {
            self.add(&format!("SHAPE_REPRESENTATION('',(#{origin}),#{context})"))
        } else {
            let shell = self.add(&format!("CLOSED_SHELL('',({}))", list(faces)));
            let solid = self.add(&format!("MANIFOLD_SOLID_BREP('',#{shell})"));
            self.add(&format!(
                "ADVANCED_BREP_SHAPE_REPRESENTATION('',(#{origin},#{solid}),#{context})"
            ))
        };
        self.shown_by(name, representation, origin)
    }

    /// A product that a representation shows.
    pub fn shown_by(&mut self, name: &str, representation: u64, origin: u64) -> Product {
        let (of_product, of_definition) = self.contexts;
        let product = self.add(&format!("PRODUCT('{name}','{name}','',(#{of_product}))"));
        let formation = self.add(&format!("PRODUCT_DEFINITION_FORMATION('','',#{product})"));
        let definition = self.add(&format!(
            "PRODUCT_DEFINITION('design','',#{formation},#{of_definition})"
        ));
        let shape = self.add(&format!("PRODUCT_DEFINITION_SHAPE('','',#{definition})"));
        self.add(&format!(
            "SHAPE_DEFINITION_REPRESENTATION(#{shape},#{representation})"
        ));
        Product {
            definition,
            representation,
            origin,
        }
    }

    /// An occurrence without a place; its number.
    pub fn usage(&mut self, name: &str, parent: Product, child: Product) -> u64 {
        let (parent, child) = (parent.definition, child.definition);
        self.add(&format!(
            "NEXT_ASSEMBLY_USAGE_OCCURRENCE('','{name}','',#{parent},#{child},$)"
        ))
    }

    /// The placement is put among the items of the parent's representation: entities may be written in any order, and this one
    /// is changed where it stands.
    fn add_item(&mut self, representation: u64, item: u64) {
        let line = self.lines.get_mut(representation as usize - 1);
        if let Some(line) = line {
            *line = line.replacen("('',(", &format!("('',(#{item},"), 1);
        }
    }

    /// An occurrence at a place in its parent.
    pub fn place(
        &mut self,
        name: &str,
        parent: Product,
        child: Product,
        at: ([f64; 3], [f64; 3], [f64; 3]),
        order: Order,
    ) {
        let usage = self.usage(name, parent, child);
        let target = self.placement(at.0, at.1, at.2);
        self.add_item(parent.representation, target);
        self.relate(usage, parent, child, target, order);
    }

    /// The relationship by which an occurrence has its place.
    pub fn relate(
        &mut self,
        usage: u64,
        parent: Product,
        child: Product,
        target: u64,
        order: Order,
    ) {
        let exchanged = |(a, b): (u64, u64), exchange: bool| if exchange { (b, a) } else { (a, b) };
        let items = exchanged((child.origin, target), order.items_exchanged);
        let both = (child.representation, parent.representation);
        let both = exchanged(both, order.representations_exchanged);
        let shape = self.add(&format!("PRODUCT_DEFINITION_SHAPE('','',#{usage})"));
        let defined = self.add(&format!(
            "ITEM_DEFINED_TRANSFORMATION('','',#{},#{})",
            items.0, items.1
        ));
        let relation = self.add(&format!(
            "(REPRESENTATION_RELATIONSHIP('','',#{},#{})\
             REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{defined})SHAPE_REPRESENTATION_RELATIONSHIP())",
            both.0, both.1
        ));
        self.add(&format!(
            "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#{relation},#{shape})"
        ));
    }

    /// An occurrence by a MAPPED_ITEM of its parent.
    pub fn place_mapped(&mut self, name: &str, parent: Product, child: Product, at: [f64; 3]) {
        self.usage(name, parent, child);
        let map = self.add(&format!(
            "REPRESENTATION_MAP(#{},#{})",
            child.origin, child.representation
        ));
        let target = self.placement(at, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        let item = self.add(&format!("MAPPED_ITEM('',#{map},#{target})"));
        self.add_item(parent.representation, item);
    }

    /// The number of the context that is in use.
    pub fn context(&self) -> u64 {
        self.context
    }

    /// The whole file.
    pub fn finished(&self) -> String {
        format!(
            "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n\
             FILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 3 1 1 }}'));\n\
             ENDSEC;\nDATA;\n{}\nENDSEC;\nEND-ISO-10303-21;\n",
            self.lines.join("\n")
        )
    }
}

/// Numbers as references.
pub(super) fn list(numbers: &[u64]) -> String {
    let references: Vec<String> = numbers.iter().map(|number| format!("#{number}")).collect();
    references.join(",")
}
