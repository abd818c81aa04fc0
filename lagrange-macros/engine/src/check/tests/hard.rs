//! Closed linkages, quaternions, friction of all kinds, piecewise and inverse functions, roots, mistakes in conditions.

use super::{judged, proven, refuted, tested, untried};

const SHELL: &str = "coordinates(r, theta), define(x = r*sin(theta), y = r*cos(theta)),
    kinetic = m/2*(der(x)^2 + der(y)^2), potential = m*g*y, contact(shell: r >= radius)";
const POINT: &str = "coordinates(x, y), kinetic = m/2*(der(x)^2 + der(y)^2), potential = m*g*y";

#[test]
fn what_is_not_named_may_be_either() {
    let fields = "m g radius";
    assert_eq!(
        judged(SHELL, fields, "check(conserved energy)"),
        ["proven in 2"]
    );
    proven(SHELL, fields, "shell == 0 when open(shell)");
    let found = refuted(SHELL, fields, "conserved momentum(theta)");
    assert!(found.contains("while shell open"), "{found}");
    // True while closed, and said without it.
    let found = refuted(
        SHELL,
        fields,
        "shell == m*g*cos(theta) - m*radius*der(theta)^2",
    );
    assert!(
        found.contains("while shell open") && found.contains("the left side is 0,"),
        "{found}"
    );
}

#[test]
fn an_energy_is_a_condition() {
    proven(
        SHELL,
        "m g radius start",
        "shell == m*g*(3*cos(theta) - 2*cos(start)) when closed(shell) and energy == m*g*radius*cos(start)",
    );
    refuted(
        SHELL,
        "m g radius start",
        "shell == m*g*(3*cos(theta) - 2*cos(start)) when closed(shell)",
    );
    refuted(
        SHELL,
        "m g radius start",
        "shell == m*g*(2*cos(theta) - cos(start)) when closed(shell) and energy == m*g*radius*cos(start)",
    );
    // At rest.
    proven(
        SHELL,
        "m g radius",
        "shell == m*g*cos(theta) when closed(shell) and der(theta) == 0",
    );
}

#[test]
fn a_message_tells_the_state_and_both_sides() {
    let found = refuted(
        SHELL,
        "m g radius",
        "der(der(theta)) == -g*sin(theta)/radius when closed(shell)",
    );
    assert_eq!(
        found,
        "2:96 E801 `der(der(theta)) == -g*sin(theta)/radius` does not hold while shell closed; \
        at m = 0.75, g = 2.31, radius = 1.9, r = 1.9, theta = -0.29, der(r) = 0, der(theta) = 0.59: \
        the left side is -0.347658, the right side 0.347658; they differ in sign only"
    );
}

#[test]
fn a_message_names_what_takes_energy() {
    let items = "coordinates(x), kinetic = m/2 * der(x)^2, potential = m*g*x, dissipation(air: c/2 * der(x)^2)";
    let one = refuted(items, "m g c", "conserved energy");
    assert!(one.ends_with("; `air` gives energy or takes it"), "{one}");
    let both = refuted(
        &format!("{items}, force(push: x = m*g)"),
        "m g c",
        "conserved energy",
    );
    assert!(
        both.ends_with("; `push`, `air` give energy or take it"),
        "{both}"
    );
    let momentum = refuted(items, "m g c", "conserved momentum(x)");
    assert!(!momentum.contains("energy"), "{momentum}");
}

#[test]
fn small_mistakes_count() {
    for small in ["0.0000001", "1e-15", "1e-30"] {
        refuted(
            SHELL,
            "m g radius",
            &format!(
                "shell == (1 + {small})*m*g*cos(theta) - m*radius*der(theta)^2 when closed(shell)"
            ),
        );
    }
    let found = refuted(POINT, "m g", "x == x*(1 + 1e-30)");
    assert!(
        found.contains("to within rounding, but they are not equal"),
        "{found}"
    );
    let pendulum = "coordinates(x, y), kinetic = m/2*(der(x)^2 + der(y)^2), potential = m*g*y,
        constraint(rod: sqrt(x^2 + y^2) == l)";
    proven(pendulum, "m g l", "rod == m*(g*y - der(x)^2 - der(y)^2)/l");
    refuted(
        pendulum,
        "m g l",
        "rod == (1 + 1e-20)*m*(g*y - der(x)^2 - der(y)^2)/l",
    );
    refuted(
        pendulum,
        "m g l",
        "rod == if(x >= 0, 1 + 1e-20, 1 - 1e-20)*m*(g*y - der(x)^2 - der(y)^2)/l",
    );
    // Multiples of the primes of both fields.
    refuted(
        POINT,
        "m g",
        "2305843009213542959*4611686018427079679*x == 0",
    );
}

#[test]
fn closed_linkages() {
    let crank = "coordinates(a, b, x),
        kinetic = inertia/2*der(a)^2 + m/2*der(x)^2,
        constraint(lengthwise: x == r*cos(a) + l*cos(b)), constraint(sideways: r*sin(a) == l*sin(b))";
    proven(
        crank,
        "inertia m r l",
        "der(x) == -r*der(a)*(sin(a) + cos(a)*tan(b))",
    );
    refuted(
        crank,
        "inertia m r l",
        "der(x) == -r*der(a)*(sin(a) - cos(a)*tan(b))",
    );
    proven(
        crank,
        "inertia m r l",
        "inertia*der(der(a)) == -m*r*(sin(a) + cos(a)*tan(b))*(-der(der(x)))",
    );
    proven(crank, "inertia m r l", "conserved energy");
    let four_bar = "coordinates(a, b, c), kinetic = i1/2*der(a)^2 + i2/2*der(c)^2 + i3/2*der(b)^2,
        constraint(lengthwise: p*cos(a) + q*cos(b) - s*cos(c) == d),
        constraint(sideways: p*sin(a) + q*sin(b) == s*sin(c))";
    proven(
        four_bar,
        "i1 i2 i3 p q s d",
        "der(c)*s*sin(c - b) == der(a)*p*sin(a - b)",
    );
    refuted(
        four_bar,
        "i1 i2 i3 p q s d",
        "der(c)*s*sin(c - b) == der(a)*p*sin(b - a)",
    );
}

#[test]
fn quaternions() {
    let top = "attitude(body: q), kinetic = i1/2*(body.body_rate[0]^2 + body.body_rate[1]^2) + i3/2*body.body_rate[2]^2,
        potential = m*g*l*body.axes[2][2]";
    proven(top, "i1 i3 m g l", "conserved energy");
    proven(top, "i1 i3 m g l", "conserved body.body_rate[2]");
    refuted(top, "i1 i3 m g l", "conserved body.body_rate[1]");
    proven(top, "i1 i3 m g l", "q[0]^2 + q[1]^2 == 1 - q[2]^2 - q[3]^2");
}

#[test]
fn friction_in_space_and_on_a_wire() {
    let ball = "coordinates(x, y, z), kinetic = m/2*(der(x)^2 + der(y)^2 + der(z)^2), potential = m*g*z,
        contact(floor: z >= 0), friction(drag on floor: slip = (der(x), der(y)), static = mu, kinetic = mu)";
    proven(
        ball,
        "m g mu",
        "der(der(x))*sqrt(der(x)^2 + der(y)^2) == -mu*g*der(x) when slips(drag)",
    );
    refuted(
        ball,
        "m g mu",
        "der(der(x))*sqrt(der(x)^2 + der(y)^2) == mu*g*der(x) when slips(drag)",
    );
    let wire = "coordinates(x, y), kinetic = m/2*(der(x)^2 + der(y)^2), potential = m*g*y,
        constraint(wire: y == c*x^2), friction(f on wire: slip = der(x), static = mu)";
    proven(wire, "m g c mu", "abs(f) == mu*abs(wire) when slips(f)");
    proven(
        wire,
        "m g c mu",
        "f == -mu*sign(slip(f))*abs(wire) when slips(f)",
    );
    refuted(
        wire,
        "m g c mu",
        "f == -mu*sign(slip(f))*wire when slips(f)",
    );
}

/// A condition on how fast something slips leaves one direction open, in whatever form it is written.
#[test]
fn speeds_of_slips() {
    let belt = "coordinates(x, phi), kinetic = m/2*der(x)^2 + i/2*der(phi)^2,
        friction(f: slip = der(x) - r*der(phi), static = mu, kinetic = mu, normal = n)";
    let fields = "m i r mu n v0";
    for fast in [
        "slip(f) >= 0.1",
        "slip(f) >= v0",
        "der(x) >= r*der(phi) + v0/2",
        "-2*r*der(phi) >= 3 - 2*der(x) + x^2",
        "slip(f) >= 1 + v0*der(phi)^2",
    ] {
        proven(
            belt,
            fields,
            &format!("f == -mu*n when slips(f) and {fast}"),
        );
        let other = refuted(belt, fields, &format!("f == mu*n when slips(f) and {fast}"));
        assert!(other.contains("f slips forward"), "{other}");
    }
    for fast in ["-0.1 >= slip(f)", "r*der(phi) >= der(x) + v0"] {
        proven(belt, fields, &format!("f == mu*n when slips(f) and {fast}"));
    }
    // Slips to either side, as fast as that, are left open by these.
    for open in [
        "slip(f) >= -0.1",
        "slip(f) >= -v0",
        "slip(f) >= der(phi)",
        "slip(f)^2 >= v0",
    ] {
        let state = refuted(
            belt,
            fields,
            &format!("f == -mu*n when slips(f) and {open}"),
        );
        assert!(state.contains("f slips backward"), "{state}");
    }
}

#[test]
fn branches() {
    let bumper = "coordinates(x), kinetic = m/2*der(x)^2, force(spring: x = -k*max(x - gap0, 0))";
    proven(
        bumper,
        "m k gap0",
        "m*der(der(x)) == if(x >= gap0, k*(gap0 - x), 0)",
    );
    proven(
        bumper,
        "m k gap0",
        "der(der(x)) == -k/m*(x - gap0) when x >= gap0",
    );
    refuted(bumper, "m k gap0", "der(der(x)) == -k/m*(x - gap0)");
    refuted(bumper, "m k gap0", "m*der(der(x)) == -k*abs(x - gap0)");
    // Wrong only far away.
    refuted(bumper, "m k gap0", "min(x, 500) == x");
    // A closed contact pushes.
    proven(SHELL, "m g radius", "abs(shell) == shell");
    proven(SHELL, "m g radius", "max(gap(shell), 0) == gap(shell)");
    // Equal, but as functions that the field does not know.
    tested(POINT, "m g", "abs(x)*abs(y) == abs(x*y)");
    tested(
        POINT,
        "m g",
        "min(x, y) + max(2*x, 2*y) == min(2*x, 2*y) + max(x, y) + (abs(x - y) - abs(x - y)) + abs(2*x - 2*y)/2 + min(x,y) - min(2*x,2*y)/2",
    );
}

#[test]
fn roots_and_inverse_functions() {
    let fields = "m g l";
    refuted(POINT, fields, "sqrt(x^2) == x");
    refuted(POINT, fields, "sqrt((x + y)^2) == x + y");
    proven(POINT, fields, "sqrt(m^2*l^2) == m*l");
    proven(POINT, fields, "sqrt(x^2)*sqrt(y^2) == sqrt(x^2*y^2)");
    tested(POINT, fields, "sqrt(x^2) == abs(x)");
    proven(
        POINT,
        fields,
        "der(atan2(y, x)) == (x*der(y) - y*der(x))/(x^2 + y^2)",
    );
    refuted(
        POINT,
        fields,
        "der(atan2(y, x)) == (x*der(y) + y*der(x))/(x^2 + y^2)",
    );
    tested(POINT, fields, "atan(exp(x)) + atan(exp(-x)) == pi/2");
    refuted(POINT, fields, "atan(exp(x)) + atan(exp(-x)) == pi/3");
    refuted(POINT, fields, "asin(sin(x)) == x");
    proven(POINT, fields, "sin(asin(x)) == x");
    proven(POINT, fields, "cos(asin(x))^2 == 1 - x^2");
    tested(POINT, fields, "ln(m*l) == ln(m) + ln(l)");
    refuted(POINT, fields, "ln(m + l) == ln(m) + ln(l)");
    proven(POINT, fields, "(m^2)^(1/3)*m^(1/3) == m");
    proven(POINT, fields, "m^x*m^y == m^(x + y)");
}

#[test]
fn wrong_conditions() {
    let two =
        "coordinates(x), kinetic = m/2*der(x)^2, contact(left: x >= 0), contact(right: x <= l)";
    let found = judged(
        two,
        "m l",
        "check(der(x) == 0 when closed(left) and closed(right))",
    );
    assert!(found[0].contains("E802"), "{found:?}");
    assert_eq!(
        judged(two, "m l", "check(der(x) == 0 when closed(left))"),
        ["proven in 1"]
    );
    let many = "coordinates(x[12]), kinetic = sum(i in 0..12: m/2*der(x[i])^2), contact(c[i in 0..12]: x[i] >= 0)";
    let found = judged(many, "m", "check(der(der(x[0])) == 0)");
    assert!(
        found[0].contains("E803") && found[0].contains("4096"),
        "{found:?}"
    );
    assert_eq!(
        judged(many, "m", "check(c[3] == 0 when closed(c[3]) and open(c))"),
        ["proven in 1"]
    );
    let found = judged(two, "m l", "check(x == 0 when left >= 0)");
    assert!(found[0].contains("E804"), "{found:?}");
    let found = judged(two, "m l", "check(x == 0 when closed(lef))");
    assert!(found[0].contains("E201"), "{found:?}");
}

#[test]
fn forces_that_the_mode_does_not_determine() {
    let table = "coordinates(y, a), kinetic = m/2*der(y)^2 + i/2*der(a)^2, potential = m*g*y,
        contact(left: y - l*a >= 0), contact(middle: y >= 0), contact(right: y + l*a >= 0)";
    let closed = "closed(left) and closed(middle) and closed(right)";
    proven(
        table,
        "m i g l",
        &format!("left + middle + right == m*g when {closed}"),
    );
    untried(table, "m i g l", &format!("left == m*g/3 when {closed}"));
}

#[test]
fn a_condition_binds_the_time() {
    let (fields, plate) = (
        "m g a w",
        "coordinates(x, y), kinetic = m/2*(der(x)^2 + der(y)^2), potential = m*g*y, contact(plate: y >= a*cos(w*t))",
    );
    let above = "closed(plate) and t == 0";
    proven(
        plate,
        fields,
        &format!("plate == m*(g - a*w^2) when {above}"),
    );
    let found = refuted(
        plate,
        fields,
        &format!("plate == m*(g + a*w^2) when {above}"),
    );
    assert!(found.contains("t = 0, y ="), "{found}");
    proven(
        plate,
        fields,
        "plate == m*g when closed(plate) and t == pi/(2*w)",
    );
    refuted(plate, fields, "plate == m*(g - a*w^2) when closed(plate)");
    // Where positions are found by iteration, so is the time.
    tested(plate, fields, "plate == m*g when closed(plate) and y == 0");
    refuted(
        plate,
        fields,
        "plate == m*g when closed(plate) and y == a/2",
    );
    // On a curve that moves along x, d/dt F(x - t, y) = 0.
    let curve = "coordinates(x, y), kinetic = m/2*(der(x)^2 + der(y)^2), constraint(wave: x - t + sin(x - t) + y + sin(y) == 1)";
    let slope = "(1 + cos(x - 2))*(der(x) - 1) + (1 + cos(y))*der(y)";
    tested(curve, "m", &format!("{slope} == 0 when t == 2"));
    refuted(curve, "m", &format!("{slope} == 0 when t == 3"));
}

#[test]
fn iterated_rows_that_depend_on_one_another() {
    let twice = |second: &str| {
        let plane = "coordinates(x, y), kinetic = m/2*(der(x)^2 + der(y)^2)";
        format!("{plane}, contact(a: x + sin(x) + y + sin(y) <= 1), contact(b: {second})")
    };
    let same = twice("2*x + 2*sin(x) + 2*y + 2*sin(y) <= 2");
    let closed = "closed(a) and closed(b)";
    // Newton's law, with normals along the gradients of the gaps.
    tested(
        &same,
        "m",
        &format!("m*der(der(x)) == -(a + 2*b)*(1 + cos(x)) when {closed}"),
    );
    tested(
        &same,
        "m",
        &format!("x + sin(x) == 1 - y - sin(y) when {closed}"),
    );
    refuted(
        &same,
        "m",
        &format!("x + sin(x) == 1 + y + sin(y) when {closed}"),
    );
    untried(&same, "m", &format!("a == b when {closed}"));
    let contrary = twice("2*x + 2*sin(x) + 2*y + 2*sin(y) >= 3");
    untried(&contrary, "m", &format!("x == y when {closed}"));
}

#[test]
fn ways_to_write_it() {
    let fields = "m g radius";
    for claim in [
        "shell == m*g*cos(theta) - m*radius*der(theta)^2 when closed(shell)",
        "normal: shell == m*g*cos(theta) - m*radius*der(theta)^2 when closed(shell)",
        "normal: conserved energy when closed(shell)",
        "conserved (energy)",
        "conserved 2*energy",
        "conserved -energy",
        "normal: conserved -2*energy when closed(shell)",
    ] {
        proven(SHELL, fields, claim);
    }
    let bodies = "coordinates(x[3]), kinetic = sum(i in 0..3: m/2*der(x[i])^2), force(push[i in 0..3]: x[i] = (i + 1)*g)";
    assert_eq!(
        judged(
            bodies,
            "m g",
            "check(a[i in 0..3]: der(der(x[i])) == (i + 1)*g/m), check(push[1] == 2*g)"
        ),
        ["proven in 1"; 4]
    );
}

#[test]
fn long_chains() {
    let chain = "coordinates(theta[12]),
        define(
            x[k in 0..12] = sum(i in 0..k + 1: l*sin(theta[i])),
            y[k in 0..12] = -sum(i in 0..k + 1: l*cos(theta[i]))),
        kinetic = sum(k in 0..12: m/2*(der(x[k])^2 + der(y[k])^2)),
        potential = sum(k in 0..12: m*g*y[k])";
    proven(chain, "m g l", "conserved energy");
    // The momentum of the whole about the support.
    proven(
        chain,
        "m g l",
        "der(sum(k in 0..12: m*(x[k]*der(y[k]) - y[k]*der(x[k])))) == -sum(k in 0..12: m*g*x[k])",
    );
    refuted(
        chain,
        "m g l",
        "der(sum(k in 0..12: m*(x[k]*der(y[k]) - y[k]*der(x[k])))) == -sum(k in 0..11: m*g*x[k])",
    );
}

#[test]
fn mistakes_in_writing_are_told() {
    let told = |check: &str| judged(SHELL, "m g radius", &format!("check({check})")).join(" | ");
    for (check, code) in [
        ("", "E002"),
        ("shell", "E001"),
        ("shell = m*g", "E006"),
        ("shell >= m*g", "E015 `>=` does not make a check"),
        ("shell == m*g when", "E001"),
        ("shell == m*g when closed", "E011"),
        ("shell == m*g when shell", "E011"),
        ("shell == m*g when closed(shell) or open(shell)", "E024"),
        ("shell == m*g when closed(shell), 2", "E016"),
        ("shell == m*g when sticks(shell)", "E206"),
        (
            "shell == m*g while closed(shell)",
            "E001 expected `when`, found `while`",
        ),
        ("m: shell == m*g", "E202"),
        ("conserved der(der(x))", "E404"),
        ("conserved shell", "E404"),
        (
            "conserved: energy",
            "E031 `:` stands in the wrong place; `conserved` is no name: write `conserved energy`",
        ),
        ("[x, y] == [y, x]", "E302"),
    ] {
        let found = told(check);
        assert!(found.contains(code), "{check}: {found}");
    }
}
