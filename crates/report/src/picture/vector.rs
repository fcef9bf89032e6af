//! Vectors of three numbers.

pub type Vector = [f64; 3];

pub fn sum(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub fn difference(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn times(a: Vector, factor: f64) -> Vector {
    a.map(|x| x * factor)
}

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: Vector, b: Vector) -> Vector {
    kutzbach_closure::cross_product(&a, &b)
}

pub fn norm(a: Vector) -> f64 {
    a[0].hypot(a[1]).hypot(a[2])
}

/// The unit vector along `a`; `None` where it has no length, or none that is finite.
pub fn unit(a: Vector) -> Option<Vector> {
    let largest = a.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    if !(largest > 0.0 && a.iter().all(|x| x.is_finite())) {
        return None;
    }
    let a = times(a, 1.0 / largest);
    let length = norm(a);
    length.is_finite().then(|| times(a, 1.0 / length))
}

pub fn is_finite(a: Vector) -> bool {
    a.iter().all(|x| x.is_finite())
}
