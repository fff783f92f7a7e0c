//! Waves against finite differences, hydrostatics and floating bodies against closed forms.

mod floating;
mod hull;
mod waves;
