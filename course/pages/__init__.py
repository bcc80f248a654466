"""What people look at: feedback, report, a sheet to talk by, and the figures on them."""
