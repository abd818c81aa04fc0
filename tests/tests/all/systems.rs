//! Systems that are not in the library, declared here, each with something independent to compare with.
