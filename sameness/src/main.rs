//! Prints the processor's SIMD instructions, then the hash and name of every case, last that of all.

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    println!("# {}", sameness::simd());
    for line in sameness::lines()? {
        println!("{:016x} {}", line.hash, line.name);
    }
    Ok(())
}
