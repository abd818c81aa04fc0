//! Every message of the macro: its code, what is wrong, and what to do next. `{0}`, `{1}`, … are blanks.
//!
//! E0xx notation · E1xx the struct · E2xx names · E3xx values · E4xx what may stand where · E5xx, E6xx mechanics · E7xx units · E8xx checks ·
//! E9xx pictures

/// A row of the table.
pub(super) struct Row {
    pub code: &'static str,
    pub message: &'static str,
    pub hint: &'static str,
}

macro_rules! table {
    ($($name:ident $code:literal $message:literal $hint:literal;)*) => {
        /// A kind of mistake.
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        pub enum Code {
            $(#[doc = $message] $name,)*
        }

        impl Code {
            pub(super) fn row(self) -> Row {
                match self {
                    $(Code::$name => Row { code: $code, message: $message, hint: $hint },)*
                }
            }

            /// All codes in the order of the table.
            #[cfg(test)]
            pub(super) const ALL: &'static [Code] = &[$(Code::$name,)*];
        }
    };
}

table! {
    Expected "E001" "expected {0}, found {1}" "";
    EmptyPart "E002" "nothing is written here" "expected {0}; or take the comma away";
    MissingComma "E003" "expected a comma before `{0}`" "parts are separated by commas";
    PowerStars "E004" "`**` is not an operator here" "a power is written with `^`: `x^2`";
    MethodCall "E005" "`.{0}()` is the notation of programs" "functions are written as in mathematics: `{1}`";
    SingleEquals "E006" "`=` where an equation is expected" "an equation is written with two: `a == b`";
    NumberSuffix "E007" "`{0}` is not a number" "{1}";
    NumberForm "E008" "`{0}` is not a number of the language" "write decimal digits: `12`, `0.5`, `1e-3`";
    NumberSize "E009" "`{0}` cannot be kept exactly" "a number in an expression has at most 38 digits: make it a parameter, which is a double";
    UnknownItem "E010" "`{0}` is not an item" "{1}";
    ComparisonExpected "E011" "expected a comparison" "write {0}";
    ComparisonAsValue "E012" "a comparison is not a value" "`if(a >= b, x, y)` chooses between values; `stop`, `mark`, `contact` and `constraint` take comparisons";
    StrictComparison "E013" "`{0}` is not used here" "write `{0}=`: a switch happens where both sides are equal";
    ChainedComparison "E014" "comparisons do not chain" "{0}";
    WrongRelation "E015" "`{0}` does not make a {1}" "{2}";
    UnknownPart "E016" "`{0}` is not a part of `{1}`" "{2}";
    RepeatedPart "E017" "`{0}` is given twice" "{1}";
    MissingPart "E018" "`{0}` has no {1}" "add `{2}`";
    Later "E019" "`{0}` comes with a later version" "{1}";
    InclusiveRange "E020" "ranges are half open" "write `a..b`, which leaves `b` out";
    RustNotation "E021" "`{0}` is not written so" "{1}";
    TooDeep "E022" "too many parentheses, powers or indices inside each other" "name inner parts with `define`";
    Exclusive "E023" "`{0}` and `{1}` exclude each other" "{2}";
    Operator "E024" "`{0}` is not an operator here" "{1}";

    NoName "E025" "this {0} has no name" "{1}";
    MissingOperator "E026" "an operator is missing before {0}" "{1}";
    FunctionPower "E027" "`{0}^…` is not a power of a value" "write `{0}(…)^2`";
    FunctionDefined "E028" "`{0}(…)` cannot be defined: there are no functions of one's own" "`define` names an expression; indexed it is `{0}[k in 0..n] = …`";
    Unreadable "E029" "what begins here cannot be read" "{0}";
    FileSize "E030" "the file has more than {0} bytes" "indices and sums say many things at once: `x[k in 0..8]`";
    Misplaced "E031" "`{0}` stands in the wrong place" "{1}";

    NotAStruct "E101" "Lagrangian is derived for a struct with named fields" "write `struct {0} { mass: f64, … }`: every field is a parameter";
    Generics "E102" "{0}" "the struct is plain (`f64` fields) or has exactly one type parameter: `struct {1}<T = f64>`";
    FieldType "E103" "a parameter cannot have this type" "fields are `{0}` or `[{0}; N]` with a number N{1}";
    AttributeForm "E104" "{0}" "{1}";
    NoDeclaration "E105" "nothing is declared" "add `#[lagrange(coordinates(…), kinetic = …, potential = …)]` to the struct";

    UnknownName "E201" "`{0}` is not known" "{1}";
    DuplicateName "E202" "`{0}` is already the name of a {1}" "parameters, coordinates, definitions and items share their names; choose another";
    ReservedName "E203" "`{0}` is a word of the language" "choose another name";
    IndexShadows "E204" "the index `{0}` hides the {1} of that name" "choose another letter";
    Circular "E205" "`{0}` is defined through itself" "break the circle: {1}";
    WrongKind "E206" "`{0}` is a {1}, not a {2}" "{3}";
    Unusable "E207" "`{0}` is a {1} and has no value" "{2}";

    HandleClash "E208" "`{0}` and `{1}` become one constant, `{2}`" "names of coordinates and items become constants in capitals: choose another";

    ConstantOfSystems "E209" "`{0}` becomes the constant `{1}`, which every system has already" "choose another name";
    NoField "E210" "`{0}` cannot be the name of a parameter" "no field of a struct of Rust can have it, and the file can be exported to one: choose another name";

    ArgumentCount "E301" "`{0}` takes {1}, not {2}" "";
    ListForScalar "E302" "a list of {0} where a single value is expected" "{1}";
    ScalarForList "E303" "a single value where a list is expected" "{0}";
    Lengths "E304" "lists of {0} and {1} elements do not fit" "both sides need as many elements";
    IndexRange "E305" "the index {0} is outside {1}..{2}" "indices start at the lower bound, and the upper bound is left out";
    NotAnInteger "E306" "expected a whole number known at build time" "indices and bounds are made of numbers and indices, not of parameters or coordinates";
    DivisionByZero "E307" "division by zero" "";
    NotAFunction "E308" "`{0}` is not a function" "{1}";
    NoSuchMember "E309" "`{0}` has no member `{1}`" "{2}";
    EmptyRange "E310" "the range {0}..{1} is empty" "the upper bound must be larger than the lower one";
    TooMany "E311" "{0} elements are too many" "a declaration may unroll to {1}";
    Overflow "E312" "{0}" "make such numbers parameters";
    ListProduct "E313" "the product of two lists has no single meaning" "write `dot(a, b)`, `cross(a, b)`, or single elements";

    NoValue "E314" "`{0}` has no value" "the numbers are outside of where it is defined";
    HighPower "E315" "this exponent is too large" "numerators and denominators of exponents go up to {0}";
    ListDivisor "E316" "nothing can be divided by a list" "divide by a single value: an element `e[i]`, `norm(e)` or `dot(e, e)`";

    VelocityHere "E401" "{0} depends on positions only, and `{1}` is a velocity" "{2}";
    AccelerationHere "E402" "`{0}` is an acceleration" "accelerations are known after the equations are solved: in `observe`, `stop`, `mark` and `check` only";
    CoordinateHere "E403" "{0} depends on parameters and t only, and `{1}` depends on the motion" "{2}";
    HigherDerivative "E404" "the derivative of an acceleration or force is not available" "";
    OutputOnly "E405" "`{0}` has a value after the equations are solved" "use it in `observe`, `stop`, `mark` or `check`";
    ForceHere "E406" "`{0}` is a {1}, whose force is not known here" "{2}";
    ConditionHere "E407" "`{0}(…)` is a condition, not a value" "use it in `stop` or `mark`, or behind `when` in a `check`, joined by `and`";

    NoCoordinates "E501" "no coordinates are declared" "add `coordinates(x, …)`";
    NoKinetic "E502" "no kinetic energy is declared" "add `kinetic = mass/2 * der(x)^2`, or a whole `lagrangian = …`";
    LagrangianExcludes "E503" "`lagrangian` stands for the kinetic and potential energies, and `{0}` is given too" "keep one of them";
    NotLinear "E504" "the {0} is not linear in `{1}`" "{2}";
    WhilePosition "E505" "a constraint that holds while a contact is closed is a velocity constraint" "write it with `der(…)`, or leave `while {0}` away";
    ConstrainsNothing "E506" "the {0} depends on no {1}" "{2}";
    NotQuadratic "E507" "with contacts the {0} must be quadratic in the velocities" "impacts need a mass matrix that does not depend on them: `{1}` occurs otherwise";
    PointElsewhere "E508" "the gap does not follow from the position of this point" "`at` takes the point relative to the body that it touches; leave it out where the gap is itself a distance";
    ForceNotLinear "E509" "the force is not linear in `{0}`" "the forces of contacts and constraints enter the equations linearly";
    SameTwice "E510" "`{0}` is given twice" "keep one";
    UnnamedTwice "E511" "a second `{0} =` without a name" "name the terms: `{0}(name: …)`";

    NegativeFriction "E512" "friction is not negative" "its sign follows from the slip: write the magnitude";
    FrictionGrows "E513" "kinetic friction {0} is larger than static friction {1}" "the kinetic coefficient is at most the static one: are they exchanged?";
    RestitutionRange "E514" "{0} is no restitution" "it lies between 0 (no bounce) and 1 (no loss)";

    KineticAtRest "E515" "{0}" "a kinetic energy is made of `der(…)`; an energy of position belongs in `potential`, with the opposite sign";
    Bearing "E516" "{0}" "{1}";
    NoRest "E517" "this Lagrangian has no value where nothing moves" "its value at rest says what is potential energy: declare `kinetic = …` and `potential = …` in its place";
    PointHeld "E518" "this point cannot move in as many directions as it has coordinates" "the gap has no slope in the others: name the point by coordinates that move freely, as in `at x`, or leave `at` out where the gap is itself a distance";
    StrongerOneWay "E519" "this friction is stronger one way than the other, and at rest it has one strength" "one of a against a positive slip s and b against a negative one is `limit = (a + b)/2` beside `force(push: (b - a)/2 along s)`; a one-way clutch has a = 0";

    NoInertia "E601" "the coordinate `{0}` has no inertia" "no kinetic energy is quadratic in `der({0})`, and no constraint ties it: add its kinetic energy, tie it with `constraint(name: der({0}) == …)`, or remove it";
    EquationCount "E602" "{0} equations for {1} unknowns" "{2}";
    Redundant "E603" "`{0}` says nothing that {1} does not say already" "take one of them away: their forces cannot be told apart";
    Contradiction "E604" "`{0}` cannot hold together with {1}" "they restrict the same motion in two ways: take one away";

    SlipsParallel "E605" "the two components of the slip of `{0}` are one" "write velocities in two directions, or a slip of one component";
    SingularInertia "E606" "{0} can move together without kinetic energy" "add the kinetic energy of that motion, or a constraint that forbids it";
    TooLarge "E607" "the equations of `{0}` outgrow {1} operands" "declare fewer elements; or give each body coordinates of its own and tie them with `constraint`: then each equation knows its neighbours only";
    TooManyRows "E608" "{0} coordinates, constraints, contacts and frictions are too many" "a declaration may have {1} together: matrices have a row for each";

    UnknownUnit "E701" "`{0}` is not a unit" "{1}";
    UnitMultiple "E702" "`{0}` is a multiple of {1}" "numbers are not converted: write `{1}`, and give the values in it";
    UnitForm "E703" "{0}" "{1}";
    UnitExpected "E704" "{0} is {1}, and this is {2}" "{3}";
    UnitsAdded "E705" "adds {0} to {1}" "{2}";
    UnitsCompared "E706" "compares {0} with {1}" "{2}";
    PressedBy "E707" "the force of `{0}` is {1}, and what presses is {2}" "{3}";
    UnitsChosen "E708" "chooses between {1} and {0}" "{2}";

    CheckFalse "E801" "`{0}` does not hold{1}" "{2}";
    CheckNever "E802" "no state fulfils the condition of this check" "{0}";
    CheckModes "E803" "the condition leaves {0} modes open" "say of more contacts whether they are `open` or `closed`; `open(name)` of an indexed contact means all its elements that are not named otherwise";
    CheckPremise "E804" "`{0}` is known after the equations are solved" "the condition of a check is made of positions, velocities, `closed(…)`, `open(…)`, `sticks(…)` and `slips(…)`";
    CheckSlips "E805" "`{0}` may slip here, pressed by several constraints together" "no check follows that: say `sticks({0})` in the condition, and compare numbers of a run in a test";
    CheckUntried "E806" "`{0}` is not proven, and could be tried at no state" "{1}; say more of the state in the condition, or compare numbers of a run in a test";

    UnknownForm "E901" "`{0}` is not the name of a form" "{1}";
    PlaceCount "E902" "`{0}` takes {1}, not {2}" "places are joined by `to`";
    PlaceSize "E903" "places have {0} coordinates here, and this has {1}" "a picture is in a plane, `(x, y)`, or in space, `(x, y, z)`";
    NotInPicture "E904" "there is no `{0}` {1}" "{2}";
    DetailSize "E905" "`{0}` takes {1} numbers, not {2}" "write them as a list, `(a, b)` in a plane and `(a, b, c)` in space";
    ChangingSize "E906" "the size of this `{0}` changes" "a body in space keeps its size: write it in parameters alone";
    ManyPlaces "E907" "a picture has at most {0} places" "draw fewer elements: nobody sees more";

    Bug "E999" "a bug in the derive: something was left out without a message" "please report it with the declaration";
}
