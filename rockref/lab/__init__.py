"""The lab: the law in C for WebAssembly, the page that runs it in a browser, and the pack of numbers that fills it."""
