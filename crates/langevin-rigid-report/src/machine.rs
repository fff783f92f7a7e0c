//! The machine that times are measured on.

/// The processor's name, as the system has it.
pub(crate) fn processor() -> String {
    name().unwrap_or_else(|| format!("unknown {} processor", std::env::consts::ARCH))
}

#[cfg(target_os = "linux")]
fn name() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|l| l.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

#[cfg(target_os = "macos")]
fn name() -> Option<String> {
    let mut command = std::process::Command::new("sysctl");
    let output = command
        .args(["-n", "machdep.cpu.brand_string"])
        .output()
        .ok()?;
    let name = String::from_utf8(output.stdout).ok()?.trim().to_owned();
    (!name.is_empty()).then_some(name)
}

#[cfg(not(any(target_os = "linux", target_os = "macos")))]
fn name() -> Option<String> {
    std::env::var("PROCESSOR_IDENTIFIER").ok()
}
