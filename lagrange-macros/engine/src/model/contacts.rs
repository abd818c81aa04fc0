//! One-sided contacts gap ≥ 0, and the factor from multiplier to normal force where `at p` is declared.
//!
//! With a = ∂gap/∂q and J = ∂p/∂q, the gap is a function of the point if aᵀ = Jᵀ n for some n, which then is the
//! gradient ∂gap/∂p: n = (J Jᵀ)⁻¹ J aᵀ, and N = λ|n|. The point is the one relative to the body that it touches (in
//! space where that does not move); other points are refused, since n would have no meaning.

use super::depth::{Context, Depth, Reach};
use super::elaboration::Elaboration;
use super::value::{Value, area, cross, dot, norm};
use super::{Contact, Restitution};
use crate::ast::{self, Comparison};
use crate::diagnostics::Code;
use crate::symbolic::ExprId;

const GAP: Context = Context::new(Reach::Positions, "a gap");
const SPEED: Context = Context::new(Reach::Motion, "a gap");
const REGION: Context = Context::new(Reach::Positions, "the region of a contact");
const POINT: Context = Context::new(Reach::Positions, "a point");
const RESTITUTION: Context = Context::new(Reach::Motion, "a restitution");

impl Elaboration<'_> {
    pub fn contact(&mut self, declared: &ast::Contact) {
        let at = declared.gap.extent();
        self.each(&declared.head, |this, name| {
            let gap = this.gap(&declared.gap);
            let restitution = match &declared.restitution {
                None => Some(Restitution::Newton(this.system.pool.integer(0))),
                Some(ast::Restitution::Newton(e)) => {
                    this.scalar(e, RESTITUTION).map(Restitution::Newton)
                }
                Some(ast::Restitution::Poisson(e)) => {
                    this.scalar(e, RESTITUTION).map(Restitution::Poisson)
                }
            };
            let region = declared
                .region
                .as_ref()
                .map(|region| this.condition(region, REGION));
            if let (Some(law), Some(value)) = (&declared.restitution, &restitution) {
                this.sensible_restitution(law, *value)?;
            }
            let gap = gap?;
            if this.depth(&[gap]) < Depth::Position {
                let hint = "write a distance between coordinates: `contact(floor: y >= 0)`";
                this.sink
                    .report(Code::ConstrainsNothing, at, &[&"gap", &"coordinate", &hint]);
                return None;
            }
            let normal_factor = match &declared.at {
                None => None,
                Some(point) => Some(this.normal_factor(gap, point)?),
            };
            let region = match region {
                None => None,
                Some(region) => Some(region?),
            };
            let force = this.symbol(&name.text, Depth::Force);
            this.system.contacts.push(Contact {
                name,
                gap,
                normal_factor,
                restitution: restitution?,
                region,
                force,
            });
            Some(this.system.contacts.len() - 1)
        });
    }

    /// A gap; of a velocity that is written as one it is told what has one sign only.
    fn gap(&mut self, declared: &Comparison) -> Option<ExprId> {
        let gap = self.difference(declared, SPEED)?;
        // What decides between its sides is a part of it.
        let mut parts = vec![gap];
        let mut read = 0;
        while let Some(&part) = parts.get(read) {
            let branches = self.system.pool.branches(part).into_iter();
            let guards = branches.map(|b| self.system.branches[b].guard);
            let new: Vec<ExprId> = guards.filter(|guard| !parts.contains(guard)).collect();
            parts.extend(new);
            read += 1;
        }
        let symbols = parts
            .iter()
            .flat_map(|&part| self.system.pool.symbols(part));
        let depths: Vec<Depth> = symbols.map(|s| self.depths[s.index()]).collect();
        if !depths.contains(&Depth::Velocity) {
            return Some(gap);
        }
        if parts.len() > 1 || depths.contains(&Depth::Position) {
            return self.difference(declared, GAP);
        }
        let speed = match declared.left.is_number() {
            true => &declared.right,
            false => &declared.left,
        };
        let hint = "a velocity s that has one sign only, as of a one-way clutch that holds H, is `force(push: H/2 along s)` with `friction(clutch: slip = s, limit = H/2)`";
        self.sink
            .report(Code::VelocityHere, speed.extent, &[&GAP.what, speed, &hint]);
        None
    }

    /// Whether a restitution that is a number is one.
    fn sensible_restitution(&mut self, law: &ast::Restitution, value: Restitution) -> Option<()> {
        let (ast::Restitution::Newton(expr) | ast::Restitution::Poisson(expr)) = law;
        let (Restitution::Newton(value) | Restitution::Poisson(value)) = value;
        let number = self.system.pool.as_number(value);
        if number.is_some_and(|number| number.is_negative() || number.to_f64() > 1.0) {
            self.sink
                .report(Code::RestitutionRange, expr.extent, &[expr]);
            return None;
        }
        Some(())
    }

    /// |∂gap/∂p|
    fn normal_factor(&mut self, gap: ExprId, point: &ast::Expr) -> Option<ExprId> {
        let point_value = match self.value(point, POINT)? {
            Value::Scalar(e) => vec![e],
            list => match list.vector() {
                Some(vector) if vector.len() <= 3 => vector,
                _ => {
                    let hint = "a point has up to three coordinates: `at (px, py)`";
                    self.sink
                        .report(Code::ScalarForList, point.extent, &[&hint]);
                    return None;
                }
            },
        };
        let moved: Vec<_> = (0..self.system.coordinates.len())
            .map(|i| self.system.moved(i))
            .collect();
        let pool = &mut self.system.pool;
        let slope: Vec<ExprId> = moved
            .iter()
            .map(|moved| pool.derivative_along(gap, moved))
            .collect();
        let jacobian: Vec<Vec<ExprId>> = point_value
            .iter()
            .map(|&p| {
                moved
                    .iter()
                    .map(|moved| pool.derivative_along(p, moved))
                    .collect()
            })
            .collect();
        let Some(normal) = self.gradient(&jacobian, &slope) else {
            let moves = |row: &Vec<ExprId>| row.iter().any(|&e| !self.system.pool.is_zero(e));
            let moving: Vec<Vec<ExprId>> = jacobian.iter().filter(|r| moves(r)).cloned().collect();
            let code = match self.gradient(&moving, &slope) {
                Some(_) => Code::PointHeld,
                None => Code::PointElsewhere,
            };
            self.sink.report(code, point.extent, &[]);
            return None;
        };
        let factor = norm(&mut self.system.pool, &normal);
        Some(self.system.pool.simplify(factor))
    }

    /// n with aᵀ = Jᵀ n, if there is one and only one, for J by rows and a.
    fn gradient(&mut self, jacobian: &[Vec<ExprId>], slope: &[ExprId]) -> Option<Vec<ExprId>> {
        let pool = &mut self.system.pool;
        let right: Vec<ExprId> = jacobian.iter().map(|row| dot(pool, row, slope)).collect();
        let gram: Vec<Vec<ExprId>> = jacobian
            .iter()
            .map(|row| jacobian.iter().map(|other| dot(pool, row, other)).collect())
            .collect();
        let gram: Vec<Vec<ExprId>> = gram
            .iter()
            .map(|row| row.iter().map(|&e| pool.simplify(e)).collect())
            .collect();
        let normal = self.solve(&gram, &right)?;
        let pool = &mut self.system.pool;
        let residuals: Vec<ExprId> = slope
            .iter()
            .enumerate()
            .map(|(j, &slope)| {
                let column: Vec<ExprId> = jacobian.iter().map(|row| row[j]).collect();
                let reached = dot(pool, &column, &normal);
                pool.sub(reached, slope)
            })
            .collect();
        self.vanish(&residuals).then_some(normal)
    }

    /// x with A x = b for a symmetric A of order up to 3, by Cramer's rule.
    fn solve(&mut self, a: &[Vec<ExprId>], b: &[ExprId]) -> Option<Vec<ExprId>> {
        let pool = &mut self.system.pool;
        let (determinant, numerators) = match (a, b) {
            ([row], &[b]) => (row[0], vec![b]),
            ([top, bottom], &[b0, b1]) => {
                let [x, y] = [[top[0], bottom[0]], [top[1], bottom[1]]];
                let right = [b0, b1];
                (
                    area(pool, x, y),
                    vec![area(pool, right, y), area(pool, x, right)],
                )
            }
            ([first, second, third], &[b0, b1, b2]) => {
                let column = |k: usize| [first[k], second[k], third[k]];
                let (x, y, z, right) = (column(0), column(1), column(2), [b0, b1, b2]);
                let (yz, zx, xy) = (cross(pool, y, z), cross(pool, z, x), cross(pool, x, y));
                let numerators = [yz, zx, xy].map(|minor| dot(pool, &right, &minor));
                (dot(pool, &x, &yz), numerators.to_vec())
            }
            _ => return None,
        };
        let determinant = pool.simplify(determinant);
        numerators
            .into_iter()
            .map(|numerator| {
                let numerator = pool.simplify(numerator);
                let quotient = pool.div(numerator, determinant)?;
                Some(pool.simplify(quotient))
            })
            .collect()
    }

    /// Whether expressions are zero at a few ordinary points: an identity is not always found by form.
    fn vanish(&self, expressions: &[ExprId]) -> bool {
        let nonzero: Vec<ExprId> = expressions
            .iter()
            .copied()
            .filter(|&e| !self.system.pool.is_zero(e))
            .collect();
        (1..=3u32).all(|trial| {
            let value = |symbol: crate::symbolic::Symbol| {
                // Irrational steps: no two symbols are in a simple ratio.
                0.3 + ((symbol.index() + 1) as f64 * 0.618_033_988_749 * f64::from(trial)).fract()
            };
            let values = self.system.pool.evaluate(&nonzero, &value, &|_| true);
            values
                .iter()
                .all(|value| !value.is_finite() || value.abs() < 1e-9)
        })
    }
}
