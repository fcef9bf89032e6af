//! (module essay)
