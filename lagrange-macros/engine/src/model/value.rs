//! Values of the language: a scalar expression, or a list of values; operations by component.

use crate::symbolic::{ExprId, Pool};

/// A scalar, or a list.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Value {
    Scalar(ExprId),
    List(Vec<Value>),
}

impl Value {
    /// Number of elements of a list.
    pub fn length(&self) -> Option<usize> {
        match self {
            Value::Scalar(_) => None,
            Value::List(elements) => Some(elements.len()),
        }
    }

    /// Number of scalars in it.
    pub fn size(&self) -> usize {
        match self {
            Value::Scalar(_) => 1,
            Value::List(elements) => elements.iter().map(Value::size).sum(),
        }
    }

    /// All scalars in it, in order.
    pub fn scalars(&self) -> Vec<ExprId> {
        match self {
            Value::Scalar(e) => vec![*e],
            Value::List(elements) => elements.iter().flat_map(Value::scalars).collect(),
        }
    }

    /// Its elements, if it is a list of scalars.
    pub fn vector(&self) -> Option<Vec<ExprId>> {
        let Value::List(elements) = self else {
            return None;
        };
        let scalar = |value: &Value| match value {
            Value::Scalar(e) => Some(*e),
            Value::List(_) => None,
        };
        elements.iter().map(scalar).collect()
    }

    /// f of every scalar.
    pub fn map(&self, f: &mut impl FnMut(ExprId) -> ExprId) -> Value {
        match self {
            Value::Scalar(e) => Value::Scalar(f(*e)),
            Value::List(elements) => {
                Value::List(elements.iter().map(|element| element.map(f)).collect())
            }
        }
    }

    /// f of every pair of scalars; `None` if the shapes differ.
    pub fn zip(
        &self,
        other: &Value,
        f: &mut impl FnMut(ExprId, ExprId) -> ExprId,
    ) -> Option<Value> {
        match (self, other) {
            (Value::Scalar(a), Value::Scalar(b)) => Some(Value::Scalar(f(*a, *b))),
            (Value::List(a), Value::List(b)) if a.len() == b.len() => {
                let elements: Option<Vec<Value>> =
                    a.iter().zip(b).map(|(a, b)| a.zip(b, f)).collect();
                elements.map(Value::List)
            }
            _ => None,
        }
    }
}

/// Σ aᵢ bᵢ
pub(super) fn dot(pool: &mut Pool, a: &[ExprId], b: &[ExprId]) -> ExprId {
    let products: Vec<ExprId> = a.iter().zip(b).map(|(&a, &b)| pool.mul(a, b)).collect();
    pool.sum(&products)
}

/// √(Σ aᵢ²)
pub(super) fn norm(pool: &mut Pool, a: &[ExprId]) -> ExprId {
    let square = dot(pool, a, a);
    pool.sqrt(square)
}

/// a × b of three components.
pub(super) fn cross(pool: &mut Pool, a: [ExprId; 3], b: [ExprId; 3]) -> [ExprId; 3] {
    let mut minor = |i: usize, j: usize| area(pool, [a[i], a[j]], [b[i], b[j]]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// a₀b₁ − a₁b₀
pub(super) fn area(pool: &mut Pool, a: [ExprId; 2], b: [ExprId; 2]) -> ExprId {
    let (left, right) = (pool.mul(a[0], b[1]), pool.mul(a[1], b[0]));
    pool.sub(left, right)
}
