// Nothing: a target must have a source to have its headers precompiled.
