//! How a module that Python loads is linked, by cargo alone too.

fn main() {
    pyo3_build_config::add_extension_module_link_args();
}
