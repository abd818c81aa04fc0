//! Structs in Thrift's compact protocol, as Parquet has its metadata: every field with its number and its type, integers zigzag in
//! groups of seven bits.
//!
//! Reference: Apache Thrift, "Thrift Compact protocol", specification, 2009.

/// Types of the protocol, as they stand before a field or an element of a list.
const I32: u8 = 5;
const I64: u8 = 6;
const BINARY: u8 = 8;
const LIST: u8 = 9;
const STRUCT: u8 = 12;

/// A struct that is being written; fields are written in ascending order of their numbers.
#[derive(Default)]
pub(super) struct Struct {
    bytes: Vec<u8>,
    /// Number of the last field.
    last: u8,
}

impl Struct {
    /// An integer or a member of an enumeration.
    pub(super) fn i32(mut self, number: u8, value: i32) -> Self {
        self.begin(number, I32);
        integer(&mut self.bytes, i64::from(value));
        self
    }

    /// A long integer.
    pub(super) fn i64(mut self, number: u8, value: i64) -> Self {
        self.begin(number, I64);
        integer(&mut self.bytes, value);
        self
    }

    /// A text.
    pub(super) fn text(mut self, number: u8, text: &str) -> Self {
        self.begin(number, BINARY);
        binary(&mut self.bytes, text);
        self
    }

    /// A struct.
    pub(super) fn nested(mut self, number: u8, value: Self) -> Self {
        self.begin(number, STRUCT);
        self.bytes.extend(value.end());
        self
    }

    /// A list of members of an enumeration.
    pub(super) fn i32s(mut self, number: u8, values: &[i32]) -> Self {
        self.begin_list(number, I32, values.len());
        for &value in values {
            integer(&mut self.bytes, i64::from(value));
        }
        self
    }

    /// A list of texts.
    pub(super) fn texts(mut self, number: u8, texts: &[&str]) -> Self {
        self.begin_list(number, BINARY, texts.len());
        for text in texts {
            binary(&mut self.bytes, text);
        }
        self
    }

    /// A list of structs.
    pub(super) fn list(mut self, number: u8, values: impl ExactSizeIterator<Item = Self>) -> Self {
        self.begin_list(number, STRUCT, values.len());
        for value in values {
            self.bytes.extend(value.end());
        }
        self
    }

    /// The struct as bytes.
    pub(super) fn end(mut self) -> Vec<u8> {
        self.bytes.push(0);
        self.bytes
    }

    /// Fields here have numbers of at most 15, so that the difference to the one before stands beside the type.
    fn begin(&mut self, number: u8, of: u8) {
        self.bytes.push((number - self.last) << 4 | of);
        self.last = number;
    }

    fn begin_list(&mut self, number: u8, of: u8, length: usize) {
        self.begin(number, LIST);
        match length {
            0..15 => self.bytes.push((length as u8) << 4 | of),
            _ => {
                self.bytes.push(0xf0 | of);
                varint(&mut self.bytes, length as u64);
            }
        }
    }
}

fn binary(bytes: &mut Vec<u8>, text: &str) {
    varint(bytes, text.len() as u64);
    bytes.extend_from_slice(text.as_bytes());
}

fn integer(bytes: &mut Vec<u8>, value: i64) {
    varint(bytes, ((value << 1) ^ (value >> 63)) as u64);
}

/// Seven bits in each byte, the lowest first; the eighth says that more follow.
pub(super) fn varint(bytes: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        bytes.push(value as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}
