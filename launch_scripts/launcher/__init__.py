"""What launch_scripts/run does once everything is built: prepare, start, watch, report."""
