"""A gloved right hand that grips the knob, made of an open hand (see LICENCES.md) and a sleeve."""
