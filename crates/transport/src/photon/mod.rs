//! Photons: how they start, travel, are kept, and are found again.
