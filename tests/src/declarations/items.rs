//! Random items: a body in a plane (x, y, theta), and beside it, each now and then, a coordinate `u` that is tied to it, one `w` whose
//! velocity is, two more `s[2]`, and a body `body` that turns in space.

use super::term::{Kinks, Leaf, Level, Term, Writer};
use super::{Declared, Source};
use crate::Random;
use core::fmt::Write;

/// Levels of an expression: few of them are deep.
const DEPTHS: [usize; 6] = [1, 2, 2, 2, 2, 3];

/// A parameter: name, unit, what it may be, range of its values.
type Parameter = (&'static str, &'static str, &'static str, [f64; 2]);

const PARAMETERS: [Parameter; 9] = [
    ("second", "s", "positive", [0.5, 2.0]),
    ("length", "m", "positive", [0.5, 2.0]),
    ("ratio", "", "", [-1.0, 1.0]),
    ("mass", "kg", "positive", [0.5, 2.0]),
    ("inertia", "kg m^2", "positive", [0.2, 1.0]),
    ("gravity", "m/s^2", "", [2.0, 10.0]),
    ("stiffness", "N/m", "nonnegative", [0.2, 2.0]),
    ("damping", "N s/m", "nonnegative", [0.1, 0.5]),
    ("push", "N", "", [0.1, 1.0]),
];

/// A declaration that is being drawn.
pub(super) struct Draft {
    random: Random,
    units: bool,
    /// Whether there is `u`, `w`, `s[2]`, `body`.
    has: [bool; 4],
    parameters: Vec<(Parameter, f64)>,
    coordinates: Vec<(&'static str, &'static str)>,
    leaves: Vec<(Leaf, Source)>,
    items: Vec<String>,
    observed: Vec<(String, f64, Term)>,
    started: Vec<(bool, usize, f64, Term)>,
    index: usize,
}

impl Draft {
    pub fn new(mut random: Random, units: bool) -> Self {
        let has = [3, 3, 3, 5].map(|n| random.below(n) == 0);
        let parameters = PARAMETERS.map(|parameter| {
            let [low, high] = parameter.3;
            // Few digits, so that the text says exactly this.
            let value = (random.between(low, high) * 1e3).round() / 1e3;
            (parameter, value)
        });
        let mut draft = Self {
            random,
            units,
            has,
            parameters: parameters.to_vec(),
            coordinates: vec![("x", "m"), ("y", "m"), ("theta", "rad")],
            leaves: Vec::new(),
            items: Vec::new(),
            observed: Vec::new(),
            started: Vec::new(),
            index: 0,
        };
        let [tied, drifts, pair, body] = has;
        if tied {
            draft.coordinates.push(("u", "m"));
        }
        if drifts {
            draft.coordinates.push(("w", "m"));
        }
        if pair {
            draft.coordinates.extend([("s[0]", "m"), ("s[1]", "m")]);
        }
        draft.name_leaves();
        if body {
            draft.name_leaves_of_body();
        }
        draft
    }

    /// What expressions are made of; the first is the unit of time.
    fn name_leaves(&mut self) {
        let (second, length) = (self.parameter("second"), self.parameter("length"));
        let ratio = self.parameter("ratio");
        self.leaf("second".to_owned(), Level::Fixed, Source::Parameter(second));
        self.leaf("ratio".to_owned(), Level::Fixed, Source::Parameter(ratio));
        self.leaf(
            "t/second".to_owned(),
            Level::Fixed,
            Source::Time(1.0 / second),
        );
        for (i, (name, unit)) in self.coordinates.clone().into_iter().enumerate() {
            let (position, velocity, size) = match unit {
                "m" => (
                    format!("{name}/length"),
                    format!("second*der({name})/length"),
                    length,
                ),
                _ => (name.to_owned(), format!("second*der({name})"), 1.0),
            };
            self.leaf(position, Level::Position, Source::Position(i, 1.0 / size));
            self.leaf(
                velocity,
                Level::Velocity,
                Source::Velocity(i, second / size),
            );
        }
    }

    fn name_leaves_of_body(&mut self) {
        let (quaternion, second) = (self.coordinates.len(), self.parameter("second"));
        let (axis, component) = (self.random.below(3), self.random.below(3));
        self.leaf(
            format!("body.axes[{axis}][{component}]"),
            Level::Position,
            Source::Axis {
                quaternion,
                axis,
                component,
            },
        );
        self.leaf(
            format!("second*body.body_rate[{axis}]"),
            Level::Velocity,
            Source::BodyRate {
                quaternion,
                axis,
                factor: second,
            },
        );
    }

    fn leaf(&mut self, text: String, level: Level, source: Source) {
        self.leaves.push((Leaf { text, level }, source));
    }

    fn parameter(&self, name: &str) -> f64 {
        let found = self
            .parameters
            .iter()
            .find(|(parameter, _)| parameter.0 == name);
        found.map_or(f64::NAN, |(_, value)| *value)
    }

    /// One in `n`.
    fn one_in(&mut self, n: usize) -> bool {
        self.random.below(n) == 0
    }

    fn one_of<'a>(&mut self, texts: &[&'a str]) -> &'a str {
        texts[self.random.below(texts.len())]
    }

    fn term(&mut self, level: Level, kinks: Kinks) -> Term {
        let leaves: Vec<Leaf> = self.leaves.iter().map(|(leaf, _)| leaf.clone()).collect();
        let depth = DEPTHS[self.random.below(DEPTHS.len())];
        let mut writer = Writer {
            random: &mut self.random,
            leaves: &leaves,
            index: &mut self.index,
            kinks,
        };
        writer.term(level, depth)
    }

    fn smooth(&mut self, level: Level) -> String {
        self.term(level, Kinks::Smooth).text
    }

    /// An expression between −1 and 1.
    fn wave(&mut self, level: Level) -> String {
        format!("sin({})", self.smooth(level))
    }

    fn item(&mut self, text: impl Into<String>) {
        self.items.push(text.into());
    }

    /// The declaration.
    pub fn finish(mut self) -> Declared {
        self.definitions();
        self.energies();
        self.constraints();
        self.contacts();
        self.loads();
        self.starts();
        self.outputs();
        self.pictures();
        self.checks();
        self.words();
        let mut text = format!(
            "//! Declaration drawn at random.\nparameters({}),\n",
            self.parameter_list()
        );
        let _ = writeln!(text, "coordinates({}),", self.coordinate_list());
        for item in &self.items {
            let _ = writeln!(text, "{item},");
        }
        Declared {
            text,
            observed: self.observed,
            started: self.started,
            leaves: self.leaves,
        }
    }

    fn parameter_list(&self) -> String {
        let one = |((name, unit, domain, _), value): &(Parameter, f64)| {
            let unit = match self.units && !unit.is_empty() {
                true => format!(": {unit:?}"),
                false => String::new(),
            };
            format!("{name}{unit} {domain} = {value}")
        };
        let mut list: Vec<String> = self.parameters.iter().map(one).collect();
        list.push("weights[2] = [1.5, 0.5], bounce = 0.5".to_owned());
        list.join(", ")
    }

    fn coordinate_list(&self) -> String {
        let one = |(name, unit): &(&str, &str)| {
            let name = name.replace("s[0]", "s[2]");
            match self.units {
                true => format!("{name}: {unit:?}"),
                false => name,
            }
        };
        let named = self.coordinates.iter().filter(|(name, _)| *name != "s[1]");
        let list: Vec<String> = named.map(one).collect();
        list.join(", ")
    }

    fn definitions(&mut self) {
        let px = self.term(Level::Position, Kinks::Smooth);
        self.item(format!("define(px = x + length*({}))", px.text));
        self.item("define(rim = [x + length*cos(theta), y + length*sin(theta)])");
        self.item("define(odd[k in 0..2] = weights[k]*length*(2*k + 1))");
    }

    fn energies(&mut self) {
        let [tied, drifts, pair, body] = self.has;
        let mut kinetic = "mass/2*(der(x)^2 + der(y)^2) + inertia/2*der(theta)^2".to_owned();
        for (there, text) in [
            (tied, " + mass/2*der(u)^2"),
            (drifts, " + mass*der(w)^2"),
            (pair, " + sum(k in 0..2: weights[k]*mass/2*der(s[k])^2)"),
            (
                body,
                " + inertia/2*dot(body.body_rate, body.body_rate) + inertia*body.body_rate[0]^2",
            ),
        ] {
            kinetic.push_str(if there { text } else { "" });
        }
        if body {
            self.item("attitude(body: q)");
        }
        let mut potential = "mass*gravity*y + stiffness/2*(x^2 + y^2)".to_owned();
        if pair {
            potential.push_str(" + sum(k in 0..2: stiffness*(s[k] - odd[k])^2)");
        }
        let random = self.term(Level::Position, Kinks::Continuous).text;
        match self.random.below(4) {
            0 => self.item(format!(
                "lagrangian = {kinetic} - ({potential}) - stiffness*length^2*({random})"
            )),
            1 => {
                self.item(format!("kinetic = {kinetic}"));
                self.item(format!(
                    "potential = {potential} + stiffness*length^2*({random})"
                ));
            }
            _ => {
                self.item(format!("kinetic(motion: {kinetic})"));
                let share = self.wave(Level::Position);
                self.item(format!("kinetic(more: (2 + {share})*mass/8*der(px)^2)"));
                self.item(format!("potential(rest: {potential})"));
                self.item(format!("potential(random: stiffness*length^2*({random}))"));
            }
        }
    }

    fn constraints(&mut self) {
        let [tied, drifts, pair, _] = self.has;
        if tied {
            // A tie never asks u of itself.
            let all = core::mem::take(&mut self.leaves);
            let others = all.iter().filter(|(leaf, _)| !leaf.text.contains('u'));
            self.leaves = others.cloned().collect();
            let wave = self.wave(Level::Position);
            self.leaves = all;
            self.item(format!("constraint(tie: u == length*{wave})"));
            if self.one_in(2) {
                self.item(
                    "friction(rub on tie: slip = der(u) - der(x), static = 1/3, kinetic = 1/5)",
                );
            }
        }
        if drifts {
            let (of_x, free) = (self.wave(Level::Position), self.wave(Level::Position));
            self.item(format!(
                "constraint(drift: der(w) + {of_x}*der(x) == length/second*{free})"
            ));
        }
        if pair && self.one_in(2) {
            self.item("constraint(locked while floor: der(s[0]) == der(s[1]))");
        }
    }

    fn contacts(&mut self) {
        let [_, drifts, pair, _] = self.has;
        let ground = self.wave(Level::Fixed);
        let law = self.one_of(&[
            "",
            ", restitution = bounce",
            ", restitution = 1/2",
            ", restitution = poisson(bounce)",
        ]);
        let (gap, at) = match self.random.below(3) {
            0 => ("y".to_owned(), " at (x, y)"),
            1 => (format!("y + length/8*{}", self.wave(Level::Position)), ""),
            _ => ("y".to_owned(), ""),
        };
        let region = self.one_of(&["", "", ", where x <= 3*length"]);
        let height = match at {
            "" => format!("length/4*{ground}"),
            _ => "0".to_owned(),
        };
        self.item(format!(
            "contact(floor: {gap} >= {height}{at}{law}{region})"
        ));
        if pair {
            self.item("contact(wall[k in 0..2]: s[k] <= 2*odd[k], restitution = bounce)");
        }
        if self.one_in(2) {
            let static_friction = self.one_of(&["2/5", "0.3 + bounce/10", "bounce"]);
            let slip = self.one_of(&[
                "der(x)",
                "der(x) + length*der(theta)",
                "(der(x), length*der(theta))",
            ]);
            let kinetic = self.one_of(&["", ", kinetic = 1/5"]);
            self.item(format!(
                "friction(grip on floor: slip = {slip}, static = {static_friction}{kinetic})"
            ));
        }
        if self.one_in(3) {
            let wave = self.wave(Level::Position);
            self.item(format!(
                "friction(seal: slip = length*der(theta), normal = push*(2 + {wave}), static = bounce, kinetic = bounce/2)"
            ));
        }
        if drifts && self.one_in(2) {
            self.item("friction(brake: slip = der(w), limit = (push, push/2))");
        }
    }

    fn loads(&mut self) {
        let [.., body] = self.has;
        let (a, b) = (
            self.term(Level::Velocity, Kinks::Any).text,
            self.wave(Level::Velocity),
        );
        self.item(format!("force(drive: x = push*({a}))"));
        if self.one_in(2) {
            self.item(format!("force(twist: theta = push*length*{b})"));
        }
        if self.one_in(2) {
            let wave = self.wave(Level::Position);
            self.item(format!("force(wind: (push*{b}, push*{wave}) at rim)"));
        }
        if self.one_in(2) {
            let (wave, arm) = (self.wave(Level::Velocity), self.wave(Level::Position));
            self.item(format!(
                "force(motor: push*{wave} along der(x) + length*{arm}*der(theta))"
            ));
        }
        if self.one_in(3) {
            let wave = self.wave(Level::Position);
            self.item(format!("define(drag = floor*{wave}/4)"));
            self.item("force(skid: theta = length*drag)");
        }
        if body {
            let wave = self.wave(Level::Position);
            self.item(format!(
                "force(lift: [0, push*{wave}, push] at length*body.axes[1])"
            ));
            self.item("dissipation(air: damping*length^2/2*dot(body.space_rate, body.space_rate))");
        }
        let share = self.wave(Level::Position);
        self.item(format!(
            "dissipation(oil: (2 + {share})*damping/2*(der(x)^2 + der(y)^2))"
        ));
        if self.has[2] {
            self.item("dissipation(damper[k in 0..2]: damping/2*(der(s[k]) - der(s[0])/2)^2)");
        }
    }

    fn starts(&mut self) {
        let length = self.parameter("length");
        let rate = length / self.parameter("second");
        let values = [
            (false, 0, "x = length*", length),
            (true, 0, "der(x) = length/second*", rate),
            (false, 2, "theta = ", 1.0),
            (true, 1, "der(y) = -length/second*", -rate),
        ];
        let mut list = Vec::new();
        for (moves, coordinate, text, factor) in values {
            let term = self.term(Level::Fixed, Kinks::Any);
            list.push(format!("{text}({})", term.text));
            self.started.push((moves, coordinate, factor, term));
        }
        list.push("y = 2*length".to_owned());
        if self.has[2] {
            let whole = self.one_in(2);
            list.push(
                if whole {
                    "s = [0, length/2]"
                } else {
                    "s[k in 0..2] = k*length"
                }
                .to_owned(),
            );
            list.push("der(s[1]) = length/second".to_owned());
        }
        if self.has[3] {
            list.push(
                "q = [1/2, 1/2, -1/2, 1/2], der(q[2]) = 1/(4*second), der(q[1]) = 1/(4*second)"
                    .to_owned(),
            );
        }
        self.item(format!("start(thrown: {})", list.join(", ")));
        self.item("start(low: y = length/2, der(theta) = 1/second)");
    }

    fn outputs(&mut self) {
        for k in 0..4 {
            let term = self.term(Level::Velocity, Kinks::Any);
            self.item(format!("observe(o{k} = push*({}))", term.text));
            self.observed
                .push((format!("o{k}"), self.parameter("push"), term));
        }
        self.item("observe(px, rim, each[k in 0..2] = odd[k]*t/second, height = gap(floor), total = energy)");
        self.item("observe(up = momentum(y), pressed = floor + mass*der(der(x)))");
        if self
            .items
            .iter()
            .any(|item| item.starts_with("friction(grip") && !item.contains("slip = ("))
        {
            self.item("observe(creep = slip(grip), held = grip)");
            self.item("mark(stops: sticks(grip) and closed(floor))");
            self.item("mark(goes: slips(grip) and x >= 0)");
        }
        let (a, b) = (
            self.term(Level::Velocity, Kinks::Any).text,
            self.term(Level::Position, Kinks::Continuous).text,
        );
        self.item(format!("mark(passes: theta/3 + {a})"));
        self.item(format!(
            "mark(reached: push*({b}) >= push*ratio and open(floor))"
        ));
        self.item("mark(heavy: floor >= 3*push)");
        self.item("stop(far: x^2 + y^2 >= 100*length^2)");
        let wave = self.wave(Level::Velocity);
        self.item(format!("stop(fast: second*der(theta) >= 20 + {wave})"));
    }

    fn pictures(&mut self) {
        let wave = self.wave(Level::Position);
        let turned = format!("theta + {wave}");
        let plane = [
            "floor: -length".to_owned(),
            "ground: (0, 0) to (length, 0) to (length, -length)".to_owned(),
            "shell: (0, -length), radius = length".to_owned(),
            "bowl: (0, length), radius = 2*length".to_owned(),
            format!("disc: (x, y), radius = length, angle = {turned}"),
            "polygon: rim to (x, y) to (0, 0)".to_owned(),
            "box: (x, y), size = (length, length/2), angle = theta".to_owned(),
            "rod: (x, y) to rim".to_owned(),
            "rope: (0, 0) to (px, y) to rim".to_owned(),
            "spring: (0, 0) to (x, y)".to_owned(),
            "mass: (px, y)".to_owned(),
            "pivot[k in 0..2]: (odd[k], 0)".to_owned(),
            "path: rim".to_owned(),
            "arrow: floor*(0, 1) at (x, y), name = load".to_owned(),
        ];
        let space = [
            "sphere: (x, y, 0), radius = length, attitude = body".to_owned(),
            "half_ellipsoid: (x, y, 0), size = (length, length, length/2), turn = [0, 0, theta]"
                .to_owned(),
            "box: (px, y, 0), size = (length, length, length), attitude = body".to_owned(),
            "disc: (x, y, length), radius = length, height = length/4, attitude = body".to_owned(),
            "rod: (x, y, 0) to length*body.axes[2]".to_owned(),
            format!("sphere: length*body.axes[0], radius = length/5, rolled = [{turned}, 0, 0]"),
            "floor: 0".to_owned(),
            "arrow: floor*[0, 0, 1] at (x, y, 0)".to_owned(),
        ];
        let forms = if self.has[3] { &space[..] } else { &plane };
        for _ in 0..3 {
            let form = forms[self.random.below(forms.len())].clone();
            let item = format!("draw({form})");
            if !self.items.contains(&item) {
                self.item(item);
            }
        }
    }

    fn checks(&mut self) {
        // Checks are proven in every mode. A pair has many, and a tie makes long accelerations.
        let [tied, _, pair, _] = self.has;
        if tied || pair {
            return;
        }
        if self.one_in(4) {
            let (a, b) = (self.smooth(Level::Position), self.wave(Level::Position));
            self.item(format!(
                "check(product: der(({a})*{b}) == der({a})*{b} + ({a})*der({b}))"
            ));
        }
        if self.one_in(4) {
            self.item("check(floor == 0 when open(floor))");
        }
        if self.one_in(4) {
            self.item("check(conserved length*ratio)");
        }
    }

    fn words(&mut self) {
        if self.one_in(3) {
            let way = self.one_of(&["together", "in_turn"]);
            self.item(format!("impacts = {way}"));
        }
        if self.one_in(2) {
            let form = self.one_of(&["unrolled", "loops", "data"]);
            self.item(format!("emit = {form}"));
        }
        if self.one_in(4) {
            self.item("crate = lagrange_core");
        }
        if self.one_in(2) {
            self.item("until = 1/2");
        }
    }
}
