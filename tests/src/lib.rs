//! Shared pieces of the cross-checks.
