//! Bake files.

use langevin_rigid::{Bake, Fluid, Input, Model, Settings, State, Stepper, TurbulenceSource};

/// Bytes before the payload: the magic, the version (u32), the payload's length (u64), the fingerprint.
const HEADER: usize = 8 + 4 + 8 + 32;

/// Reads a bake; a body that it accepts can be stepped.
pub(crate) fn read(bytes: &[u8]) {
    match Bake::from_bytes(bytes) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(bake) => {
            let written = bake.to_bytes();
            assert_eq!(Bake::from_bytes(&written).unwrap().to_bytes(), written);
            step(&bake);
        }
    }
}

/// The same with the magic, the version, the length and the checksum put right.
pub(crate) fn read_sealed(bytes: &[u8]) {
    read(&sealed(bytes));
}

fn sealed(bytes: &[u8]) -> Vec<u8> {
    let mut file = bytes.to_vec();
    file.resize(bytes.len().max(HEADER + 8), 0);
    let end = file.len() - 8;
    file[..8].copy_from_slice(b"LRBAKE\r\n");
    file[8..12].copy_from_slice(&2u32.to_le_bytes());
    file[12..20].copy_from_slice(&((end - HEADER) as u64).to_le_bytes());
    let checksum = fnv1a(&file[..end]);
    file[end..].copy_from_slice(&checksum.to_le_bytes());
    file
}

/// The 64-bit FNV-1a hash (Fowler, Noll, Vo).
fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Whatever the body is, its states are finite or there is an error.
fn step(bake: &Bake) {
    let turbulence = match &bake.history {
        Some(_) => TurbulenceSource::History,
        None => TurbulenceSource::default(),
    };
    for model in [Model::Separated, Model::Consistent, Model::Kirchhoff] {
        let settings = Settings {
            model,
            turbulence,
            ..Settings::default()
        };
        let stepper = Stepper::new(&bake.body, &Fluid::WATER, bake.history.as_ref(), &settings);
        let Ok(stepper) = stepper else { continue };
        let mut state = State::default();
        for _ in 0..3 {
            if let Err(error) = stepper.step(&mut state, 1e-3, &Input::default()) {
                assert!(!error.to_string().is_empty());
                break;
            }
            assert!(state.is_finite(), "{model}: {state:?}");
        }
    }
}
