"""The figures of the dashboard: numbers and captions here, drawing in dashboard.js."""
