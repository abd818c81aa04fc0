//! Pages and pictures as trees of tags.

/// Names of tags that are opened and not closed in order; what is in scripts and styles is skipped.
pub fn unclosed(page: &str) -> Vec<&str> {
    let mut open = Vec::new();
    let mut rest = page;
    while let Some((_, tag)) = rest.split_once('<') {
        let (tag, after) = tag.split_once('>').expect("the end of a tag");
        let name = tag.trim_start_matches('/');
        let name = name.split(|c: char| c.is_whitespace()).next().unwrap_or("");
        rest = after;
        if tag.starts_with('!') || tag.ends_with('/') {
            continue;
        }
        if !tag.starts_with('/') {
            open.push(name);
        } else if open.pop() != Some(name) {
            return vec![name];
        }
        if let ("script" | "style", false) = (name, tag.starts_with('/')) {
            let end = after.find("</").expect("an end");
            rest = &after[end..];
        }
    }
    open
}
