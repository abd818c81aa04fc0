//! x
use crate::accuracy::Accuracy;
/// x
/// # Errors
/// x
pub fn svg(_accuracy: &Accuracy) -> Result<String, String> {
    Err(String::new())
}
