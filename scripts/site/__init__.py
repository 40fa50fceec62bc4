"""The site: parts as WebAssembly, sessions, words for bytes, pages (`make site`, `make test-web`)."""
