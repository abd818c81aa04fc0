//! The struct itself, by syn: name, documentation, the scalar, fields, and the attributes that hold the items.

use super::cursor::Cursor;
use super::item;
use crate::ast::{Declaration, Domain, Field, Home, Name, Unit};
use crate::diagnostics::{Code, Diagnostics, Extent};
use proc_macro2::{Ident, TokenStream};
use syn::spanned::Spanned;
use syn::{Attribute, Data, DeriveInput, Expr, Fields, GenericParam, Lit, Meta, Type};

pub(super) fn declaration(input: TokenStream, sink: &mut Diagnostics) -> Option<Declaration> {
    let input: DeriveInput = match syn::parse2(input) {
        Ok(input) => input,
        Err(error) => {
            sink.absorb(error);
            return None;
        }
    };
    let scalar = scalar(&input, sink);
    let fields = match &input.data {
        Data::Struct(data) => match &data.fields {
            Fields::Named(named) => Some(&named.named),
            _ => None,
        },
        _ => None,
    };
    let Some(fields) = fields else {
        sink.report(Code::NotAStruct, &input.ident, &[&input.ident]);
        return None;
    };
    let fields = fields
        .iter()
        .filter_map(|f| field(f, scalar.as_ref(), sink))
        .collect();
    let (items, core) = items(&input, sink);
    Some(Declaration {
        documentation: documentation(&input.attrs),
        name: input.ident,
        scalar,
        fields,
        items,
        core,
        home: Home::Struct,
    })
}

/// No generics, or exactly one type parameter.
fn scalar(input: &DeriveInput, sink: &mut Diagnostics) -> Option<Ident> {
    let mut refuse = |what: &str, at: Extent| {
        sink.report(Code::Generics, at, &[&what, &input.ident]);
    };
    let mut scalar = None;
    for bound in input.generics.type_params().flat_map(|ty| &ty.bounds) {
        refuse("a bound on the type parameter", bound.span().into());
    }
    for parameter in &input.generics.params {
        let at = parameter.span().into();
        match parameter {
            GenericParam::Type(ty) if scalar.is_none() => scalar = Some(ty.ident.clone()),
            GenericParam::Type(_) => refuse("a second type parameter", at),
            GenericParam::Lifetime(_) => refuse("a lifetime parameter", at),
            GenericParam::Const(_) => refuse("a const parameter", at),
        }
    }
    if let Some(clause) = &input.generics.where_clause {
        refuse("a `where` clause", clause.where_token.span().into());
    }
    scalar
}

fn field(field: &syn::Field, scalar: Option<&Ident>, sink: &mut Diagnostics) -> Option<Field> {
    let expected = scalar.map_or("f64".to_string(), Ident::to_string);
    let others = match scalar {
        None => {
            "; for other numbers give the struct a parameter, `struct S<T = f64>`, and fields that are `T`"
        }
        Some(_) => "",
    };
    let is_scalar =
        |ty: &Type| matches!(visible(ty), Type::Path(path) if path.path.is_ident(&expected));
    let length = match visible(&field.ty) {
        ty if is_scalar(ty) => None,
        Type::Array(array) if is_scalar(&array.elem) => {
            let length = length(&array.len);
            if length.is_none() {
                sink.report(Code::FieldType, array.len.span(), &[&expected, &others]);
                return None;
            }
            length
        }
        ty => {
            sink.report(Code::FieldType, ty.span(), &[&expected, &others]);
            return None;
        }
    };
    let name = Name::new(field.ident.as_ref()?);
    Some(described(name, length, &field.attrs, sink))
}

/// A field with what its attributes say.
pub(super) fn described(
    name: Name,
    length: Option<usize>,
    attributes: &[Attribute],
    sink: &mut Diagnostics,
) -> Field {
    let mut field = Field {
        name,
        length,
        documentation: documentation(attributes),
        tex: String::new(),
        unit: None,
        letter: String::new(),
        domain: None,
    };
    for attribute in attributes.iter().filter(|a| a.path().is_ident("lagrange")) {
        for mut part in parts(attribute, "unit = \"kg\"", sink) {
            field_attribute(&mut part, &mut field, sink);
        }
    }
    field
}

/// A type without the invisible groups around what a `macro_rules!` substituted.
fn visible(ty: &Type) -> &Type {
    match ty {
        Type::Group(group) => visible(&group.elem),
        ty => ty,
    }
}

/// The number N of `[T; N]`.
fn length(length: &Expr) -> Option<usize> {
    match length {
        Expr::Group(group) => self::length(&group.expr),
        Expr::Lit(literal) => match &literal.lit {
            Lit::Int(length) => length.base10_parse().ok(),
            _ => None,
        },
        _ => None,
    }
}

/// `unit = "kg"`
fn field_attribute(part: &mut Cursor, field: &mut Field, sink: &mut Diagnostics) -> Option<()> {
    let keys = ["tex", "unit", "symbol", "domain"];
    let key = item::key(part, "#[lagrange(…)]", &keys, sink)?;
    let extent = part.here();
    let text = item::text(part, "a text in quotation marks", sink)?;
    let given = match key.text.as_str() {
        "tex" => !field.tex.is_empty(),
        "unit" => field.unit.is_some(),
        "domain" => field.domain.is_some(),
        _ => !field.letter.is_empty(),
    };
    if given {
        sink.report(Code::RepeatedPart, &key, &[&key.text, &"keep one"]);
    }
    match key.text.as_str() {
        "tex" => field.tex = text,
        "unit" => field.unit = Some(Unit { text, extent }),
        "domain" => field.domain = Some(domain(&text, extent, sink)?),
        _ => field.letter = text,
    }
    super::leftover::leftover(part, sink)
}

/// Whether the word is one that [`domain`] reads.
pub(super) fn is_domain(text: &str) -> bool {
    Domain::ALL.iter().any(|(word, _)| *word == text)
}

/// `positive` or `nonnegative`.
pub(super) fn domain(text: &str, extent: Extent, sink: &mut Diagnostics) -> Option<Domain> {
    let known = Domain::ALL.iter().find(|(word, _)| *word == text);
    if known.is_none() {
        let found = format!("`{text}`");
        sink.report(
            Code::Expected,
            extent,
            &[&"`positive` or `nonnegative`", &found],
        );
    }
    known.map(|(_, domain)| *domain)
}

/// All items of all attributes, and `crate = path`.
fn items(
    input: &DeriveInput,
    sink: &mut Diagnostics,
) -> (Vec<crate::ast::Item>, Option<TokenStream>) {
    let mut read = item::Items::default();
    let mut found = false;
    for attribute in input.attrs.iter().filter(|a| a.path().is_ident("lagrange")) {
        found = true;
        for mut part in parts(attribute, "coordinates(x), kinetic = …", sink) {
            item::items(&mut part, &mut read, sink);
        }
    }
    if !found {
        sink.report(Code::NoDeclaration, &input.ident, &[]);
    }
    (read.items, read.core)
}

/// The parts of `#[lagrange(…)]`.
fn parts(attribute: &Attribute, example: &str, sink: &mut Diagnostics) -> Vec<Cursor> {
    match &attribute.meta {
        Meta::List(list) => {
            let close = list.delimiter.span().close();
            Cursor::new(list.tokens.clone(), close.into(), 0).parts("an item", sink)
        }
        other => {
            let hint = format!("write `#[lagrange({example})]`");
            sink.report(
                Code::AttributeForm,
                other.span(),
                &[&"`lagrange` takes parentheses", &hint],
            );
            Vec::new()
        }
    }
}

/// Doc comments, one line each, without the space that follows `///`.
pub(super) fn documentation(attributes: &[Attribute]) -> String {
    let mut lines = Vec::new();
    for attribute in attributes.iter().filter(|a| a.path().is_ident("doc")) {
        if let Meta::NameValue(pair) = &attribute.meta
            && let Expr::Lit(literal) = &pair.value
            && let Lit::Str(text) = &literal.lit
        {
            let text = text.value();
            lines.extend(text.split('\n').map(|line| {
                line.strip_prefix(' ')
                    .unwrap_or(line)
                    .trim_end()
                    .to_string()
            }));
        }
    }
    lines.join("\n").trim().to_string()
}
