//! The plan keeps the value of every output, whatever is held, and does not waste operations.

use super::*;
