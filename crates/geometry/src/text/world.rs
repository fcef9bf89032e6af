//! A world from text: an entity on each line, boundaries between `solid` or `surface` and `end`.

use super::{Cursor, Legible, TextError, Token, TokenKind, read_expression, read_number, tokens};
use crate::boundary::{Boundary, BoundaryBuilder, Face};
use crate::curved::{Circle, Cone, Cylinder, Sphere};
use crate::entity::{Direction, Entity, Line, Plane, Point, Segment, Vector};
use crate::error::GeometryError;
use crate::world::{Id, World};
use kutzbach_math::number::Number;
use std::collections::BTreeMap;
use std::ops::Range;

/// What a line may begin with.
const KEYWORDS: &str = "number, vector, direction, point, line, plane, segment, circle, cylinder, cone, sphere, face, \
                        surface or solid";

/// What a text said.
#[derive(Clone, Debug)]
pub struct Reading<S> {
    /// The entities. Faces, edges and vertices of a boundary `plate` are `plate.NAME`, `plate.edge0`, `plate.NAME`.
    pub world: World<S>,
    /// Numbers with names.
    pub numbers: BTreeMap<String, Number>,
    /// The names of the boundaries in the order of the text.
    pub boundaries: Vec<String>,
    /// For each boundary the names of its faces in the world, by their numbers.
    pub faces: BTreeMap<String, Vec<String>>,
    /// For each boundary the names of its vertices in the world, by their numbers.
    pub vertices: BTreeMap<String, Vec<String>>,
}

/// Reads a world. The page on geometry has the form of the text.
///
/// # Errors
/// For the first line that says no entity, or a degenerate one, with its place, what was needed and what was found.
pub fn read_world<S: Legible>(source: &str) -> Result<Reading<S>, TextError> {
    let tokens = tokens(source)?;
    let mut reader = Reader {
        cursor: Cursor::new(source, &tokens),
        made_from: Vec::new(),
        reading: Reading {
            world: World::new(),
            numbers: BTreeMap::new(),
            boundaries: Vec::new(),
            faces: BTreeMap::new(),
            vertices: BTreeMap::new(),
        },
    };
    loop {
        reader.cursor.skip_lines();
        if reader.cursor.is_done() {
            return Ok(reader.reading);
        }
        reader.line()?;
        reader.end_of_line()?;
    }
}

struct Reader<'a, S> {
    cursor: Cursor<'a>,
    /// What the entity of this line refers to.
    made_from: Vec<Id>,
    reading: Reading<S>,
}

/// What is collected between `solid` and `end`.
struct Block<S> {
    builder: BoundaryBuilder<S>,
    vertices: BTreeMap<String, usize>,
    vertex_names: Vec<String>,
    face_names: Vec<String>,
    face_places: Vec<Range<usize>>,
}

impl<'a, S: Legible> Reader<'a, S> {
    fn line(&mut self) -> Result<(), TextError> {
        self.made_from.clear();
        let needed = format!("a line that begins with {KEYWORDS}");
        let keyword = self.cursor.word(&needed)?;
        let name = self.cursor.word("a name for it")?;
        if keyword.text == "number" {
            return self.named_number(name);
        }
        if keyword.text == "solid" || keyword.text == "surface" {
            return self.boundary(name, keyword.text == "solid");
        }
        let entity: Entity<S> = match keyword.text {
            "vector" => Vector(self.triple()?).into(),
            "point" => Point(self.triple()?).into(),
            "direction" => self.direction()?.into(),
            "line" => self.straight()?.into(),
            "plane" => self.plane()?.into(),
            "segment" => self.segment()?.into(),
            "circle" => self.circle()?.into(),
            "cylinder" => self.cylinder()?.into(),
            "cone" => self.cone()?.into(),
            "sphere" => self.sphere()?.into(),
            "face" => self.face()?.into(),
            _ => {
                let span = keyword.span.clone();
                let source = self.cursor.source();
                return Err(TextError::needed(source, span, needed, keyword.shown()));
            }
        };
        self.store(name, name.text, entity).map(|_| ())
    }

    fn end_of_line(&mut self) -> Result<(), TextError> {
        match self.cursor.take() {
            None => Ok(()),
            Some(token) if token.kind == TokenKind::LineEnd => Ok(()),
            Some(token) => Err(TextError::needed(
                self.cursor.source(),
                token.span.clone(),
                "the end of the line",
                token.shown(),
            )),
        }
    }

    fn store(&mut self, place: &Token<'_>, name: &str, entity: Entity<S>) -> Result<Id, TextError> {
        let source = self.cursor.source();
        self.reading
            .world
            .store_made_from(name, entity, &self.made_from)
            .map_err(|error| TextError::at(source, place.span.clone(), error.to_string()))
    }

    fn named_number(&mut self, name: &Token<'_>) -> Result<(), TextError> {
        let number = match self.cursor.peek() {
            Some(token) if token.kind == TokenKind::Number => {
                self.cursor.take();
                Number::decimal(token.text).map_err(|error| self.wrong(token, error.to_string()))?
            }
            _ => self.expression()?.1,
        };
        let numbers = &mut self.reading.numbers;
        match numbers.insert(name.text.to_owned(), number) {
            None => Ok(()),
            Some(_) => {
                Err(self.wrong(name, format!("the number `{}` is there already", name.text)))
            }
        }
    }

    fn wrong(&self, token: &Token<'_>, message: impl Into<String>) -> TextError {
        TextError::at(self.cursor.source(), token.span.clone(), message)
    }

    /// An error of geometry, told at a place.
    fn degenerate(&self, from: usize, error: &GeometryError) -> TextError {
        let span = from..self.cursor.behind().max(from);
        TextError::at(self.cursor.source(), span, error.to_string())
    }

    fn expression(&mut self) -> Result<(S, Number), TextError> {
        let token = match self.cursor.peek() {
            Some(token) if token.kind == TokenKind::Expression => token,
            _ => {
                return Err(self
                    .cursor
                    .needed("a number, such as `0.5` or `${sqrt(3)/2}`"));
            }
        };
        self.cursor.take();
        let inside = token
            .text
            .strip_prefix("${")
            .and_then(|text| text.strip_suffix('}'))
            .unwrap_or_default();
        read_expression(inside, &self.reading.numbers).map_err(|(offset, message)| {
            let start = token.span.start + 2 + offset;
            let end = (start + 1).min(token.span.end).max(start);
            TextError::at(self.cursor.source(), start..end, message)
        })
    }

    fn number(&mut self) -> Result<S, TextError> {
        match self.cursor.peek() {
            Some(token) if token.kind == TokenKind::Number => {
                self.cursor.take();
                read_number(token.text).map_err(|message| self.wrong(token, message))
            }
            _ => self.expression().map(|(number, _)| number),
        }
    }

    fn triple(&mut self) -> Result<[S; 3], TextError> {
        Ok([self.number()?, self.number()?, self.number()?])
    }

    /// An entity that was named before.
    fn known(&mut self) -> Result<(&'a Token<'a>, Entity<S>), TextError> {
        let token = self.cursor.word("three numbers or the name of an entity")?;
        let world = &self.reading.world;
        let id = world.find(token.text);
        match id.and_then(|id| Some((id, world.get(id)?.clone()))) {
            Some((id, entity)) => {
                self.made_from.push(id);
                Ok((token, entity))
            }
            None => {
                let message = format!(
                    "needed an entity that was named before, found `{}`",
                    token.text
                );
                Err(self.wrong(token, message))
            }
        }
    }

    fn begins_number(&self) -> bool {
        self.cursor
            .peek()
            .is_some_and(|t| matches!(t.kind, TokenKind::Number | TokenKind::Expression))
    }

    fn point(&mut self) -> Result<Point<S>, TextError> {
        if self.begins_number() {
            return Ok(Point(self.triple()?));
        }
        match self.known()? {
            (_, Entity::Point(point)) => Ok(point),
            (token, other) => {
                Err(self.wrong(token, format!("needed a point, found a {}", other.kind())))
            }
        }
    }

    fn direction(&mut self) -> Result<Direction<S>, TextError> {
        let from = self.cursor.place().start;
        if self.begins_number() {
            let components = self.triple()?;
            return Direction::new(components).map_err(|error| self.degenerate(from, &error));
        }
        match self.known()? {
            (_, Entity::Direction(direction)) => Ok(direction),
            (_, Entity::Line(line)) => Ok(line.direction().clone()),
            (_, Entity::Plane(plane)) => Ok(plane.normal().clone()),
            (token, other) => {
                let found = other.kind();
                let message = format!("needed a direction, a line or a plane, found a {found}");
                Err(self.wrong(token, message))
            }
        }
    }

    /// A word that has to be there.
    fn keyword(&mut self, word: &str) -> Result<(), TextError> {
        match self.cursor.take_word(word) {
            true => Ok(()),
            false => Err(self.cursor.needed(format!("`{word}`"))),
        }
    }

    fn straight(&mut self) -> Result<Line<S>, TextError> {
        let from = self.cursor.place().start;
        let point = self.point()?;
        if self.cursor.take_word("through") {
            let second = self.point()?;
            return Line::through(point, &second).map_err(|error| self.degenerate(from, &error));
        }
        match self.cursor.take_word("along") {
            true => Ok(Line::new(point, self.direction()?)),
            false => Err(self
                .cursor
                .needed("`along` and a direction, or `through` and a point")),
        }
    }

    fn plane(&mut self) -> Result<Plane<S>, TextError> {
        let from = self.cursor.place().start;
        if self.cursor.take_word("through") {
            let (a, b, c) = (self.point()?, self.point()?, self.point()?);
            return Plane::through(a, &b, &c).map_err(|error| self.degenerate(from, &error));
        }
        let point = self.point()?;
        self.keyword("normal")?;
        Ok(Plane::new(point, self.direction()?))
    }

    fn segment(&mut self) -> Result<Segment<S>, TextError> {
        let from = self.cursor.place().start;
        let first = self.point()?;
        self.keyword("to")?;
        let second = self.point()?;
        Segment::new(first, second).map_err(|error| self.degenerate(from, &error))
    }

    fn circle(&mut self) -> Result<Circle<S>, TextError> {
        let from = self.cursor.place().start;
        let centre = self.point()?;
        self.keyword("normal")?;
        let normal = self.direction()?;
        self.keyword("radius")?;
        let radius = self.number()?;
        Circle::new(centre, normal, radius).map_err(|error| self.degenerate(from, &error))
    }

    fn cylinder(&mut self) -> Result<Cylinder<S>, TextError> {
        let from = self.cursor.place().start;
        let point = self.point()?;
        self.keyword("along")?;
        let axis = Line::new(point, self.direction()?);
        self.keyword("radius")?;
        let radius = self.number()?;
        Cylinder::new(axis, radius).map_err(|error| self.degenerate(from, &error))
    }

    fn cone(&mut self) -> Result<Cone<S>, TextError> {
        let from = self.cursor.place().start;
        let apex = self.point()?;
        self.keyword("along")?;
        let along = self.direction()?;
        self.keyword("tangent")?;
        let tangent = self.number()?;
        Cone::new(apex, along, tangent).map_err(|error| self.degenerate(from, &error))
    }

    fn sphere(&mut self) -> Result<Sphere<S>, TextError> {
        let from = self.cursor.place().start;
        let centre = self.point()?;
        self.keyword("radius")?;
        let radius = self.number()?;
        Sphere::new(centre, radius).map_err(|error| self.degenerate(from, &error))
    }

    /// Whether another corner or hole follows on this line.
    fn goes_on(&self) -> bool {
        self.cursor
            .peek()
            .is_some_and(|token| token.kind != TokenKind::LineEnd)
    }

    fn face(&mut self) -> Result<Face<S>, TextError> {
        let from = self.cursor.place().start;
        let mut loops = Vec::new();
        let mut own = Vec::new();
        while self.goes_on() {
            match self.cursor.take_word("hole") {
                true => loops.push(std::mem::take(&mut own)),
                false => own.push(self.point()?),
            }
        }
        loops.push(own);
        Face::new(loops).map_err(|error| self.degenerate(from, &error))
    }

    fn boundary(&mut self, name: &'a Token<'a>, is_solid: bool) -> Result<(), TextError> {
        self.end_of_line()?;
        let mut block = Block {
            builder: BoundaryBuilder::new(),
            vertices: BTreeMap::new(),
            vertex_names: Vec::new(),
            face_names: Vec::new(),
            face_places: Vec::new(),
        };
        loop {
            self.cursor.skip_lines();
            let needed = "a line that begins with `vertex`, `face` or `end`";
            let keyword = self.cursor.word(needed)?;
            match keyword.text {
                "vertex" => self.vertex(name.text, &mut block)?,
                "face" => self.block_face(name.text, &mut block)?,
                "end" => break,
                _ => {
                    let source = self.cursor.source();
                    let span = keyword.span.clone();
                    return Err(TextError::needed(source, span, needed, keyword.shown()));
                }
            }
            self.end_of_line()?;
        }
        let Block {
            builder,
            vertex_names,
            face_names,
            face_places,
            ..
        } = block;
        let built = match is_solid {
            true => builder.build_solid(),
            false => builder.build(),
        };
        let boundary = built.map_err(|error| {
            let face = match &error {
                GeometryError::NoFace { spot, .. } => spot.face,
                _ => None,
            };
            let place = face.and_then(|face| face_places.get(face));
            let span = place.unwrap_or(&name.span).clone();
            TextError::at(self.cursor.source(), span, error.to_string())
        })?;
        self.store_boundary(name, boundary, &vertex_names, &face_names)?;
        let owner = name.text.to_owned();
        self.reading.boundaries.push(owner.clone());
        self.reading.faces.insert(owner.clone(), face_names);
        self.reading.vertices.insert(owner, vertex_names);
        Ok(())
    }

    fn vertex(&mut self, owner: &str, block: &mut Block<S>) -> Result<(), TextError> {
        let name = self.cursor.word("a name for the vertex")?;
        let at = self.point()?;
        let number = block.builder.vertex(at);
        block.vertex_names.push(format!("{owner}.{}", name.text));
        match block.vertices.insert(name.text.to_owned(), number) {
            None => Ok(()),
            Some(_) => {
                Err(self.wrong(name, format!("the vertex `{}` is there already", name.text)))
            }
        }
    }

    fn block_face(&mut self, owner: &str, block: &mut Block<S>) -> Result<(), TextError> {
        let name = self.cursor.word("a name for the face")?;
        let mut loops = Vec::new();
        let mut own = Vec::new();
        while self.goes_on() {
            if self.cursor.take_word("hole") {
                loops.push(std::mem::take(&mut own));
                continue;
            }
            let token = self
                .cursor
                .word("the name of a vertex of this boundary, or `hole`")?;
            match block.vertices.get(token.text) {
                Some(number) => own.push(*number),
                None => {
                    let message =
                        format!("needed a vertex of this boundary, found `{}`", token.text);
                    return Err(self
                        .wrong(token, message)
                        .help("vertices come before their faces"));
                }
            }
        }
        loops.push(own);
        block.builder.face(loops);
        block.face_names.push(format!("{owner}.{}", name.text));
        block.face_places.push(name.span.clone());
        Ok(())
    }

    /// The boundary, and its faces, edges and vertices as parts of it.
    fn store_boundary(
        &mut self,
        name: &Token<'_>,
        boundary: Boundary<S>,
        vertex_names: &[String],
        face_names: &[String],
    ) -> Result<(), TextError> {
        let whole = self.store(name, name.text, boundary.clone().into())?;
        self.made_from = vec![whole];
        for (face, own) in boundary.faces().iter().zip(face_names) {
            self.store(name, own, face.clone().into())?;
        }
        for (vertex, own) in boundary.vertices().iter().zip(vertex_names) {
            self.store(name, own, vertex.clone().into())?;
        }
        for number in 0..boundary.edges().len() {
            let edge = boundary.segment(number);
            let edge = edge.map_err(|error| self.degenerate(name.span.start, &error))?;
            self.store(name, &format!("{}.edge{number}", name.text), edge.into())?;
        }
        Ok(())
    }
}
