//! Commands as a shell takes them.

/// `lagrange` with these arguments, for a shell: what it would take apart stands between quotes.
pub(super) fn command(arguments: impl IntoIterator<Item = String>) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,+@%".contains(c);
    let quoted = arguments.into_iter().map(|argument| {
        match argument.is_empty() || !argument.chars().all(plain) {
            true => format!("'{}'", argument.replace('\'', "'\\''")),
            false => argument,
        }
    });
    let words: Vec<String> = core::iter::once("lagrange".to_owned())
        .chain(quoted)
        .collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::command;

    #[test]
    fn commands_can_be_given_to_a_shell_again() {
        let given = ["report", "a b.toml", "--set", "name=it's", ""];
        let told = command(given.map(str::to_owned));
        assert_eq!(told, r"lagrange report 'a b.toml' --set 'name=it'\''s' ''");
    }
}
