//! Tests of the pool.

use super::*;

#[test]
fn canonical() {
    let mut p = Pool::new();
    let (x, y) = (p.symbol("x"), p.symbol("y"));
    let (xs, ys) = (x, y);
    let (x, y) = (p.leaf(x), p.leaf(y));
    let two = p.integer(2);
    let s = p.call(Function::Sin, &[x]);
    let c = p.call(Function::Cos, &[x]);
    let s2 = p.pow(s, two).unwrap();
    let c2 = p.pow(c, two).unwrap();
    let one = p.add(s2, c2);
    assert!(p.is_one(one));
    let a = p.product(&[s2, y]);
    let b = p.product(&[c2, y]);
    assert_eq!(p.add(a, b), y);
    assert_eq!(p.sub(y, a), b);
    assert_eq!(p.sub(a, y), p.neg(b));
    let d = p.differentiate(s, xs);
    assert_eq!(d, c);
    let d = p.differentiate(a, ys);
    assert_eq!(d, s2);
    let q = p.sqrt(y);
    assert_eq!(p.mul(q, q), y);
    let y2 = p.pow(y, two).unwrap();
    assert_ne!(p.sqrt(y2), y);
    let r = p.sqrt(y2);
    assert_eq!(p.mul(r, r), y2);
}
